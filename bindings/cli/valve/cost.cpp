#include "valve/cost.h"

#include "text/command_units.h"
#include "text/op_forms.h"

namespace cli {
namespace {

// a division rounds 10 ml/s to the limit of the library, a product with 1e-6 rounds it below
constexpr double ml_per_m3 = 1e6;

// An error sentence for a flow outside of the limits of the library, such as one in l/s, else "".
std::string wrong_flow(const std::string &given) {
  double flow = 0;
  if (!read_number(given, flow)) return "'" + given + "' is not a number in ml/s";
  if (flow / ml_per_m3 >= MVS_FLOW_MIN && flow / ml_per_m3 <= MVS_FLOW_MAX) return "";
  return text(
      "%s ml/s is no flow through an open mitral valve, which is about 250 ml/s in "
      "diastole, %g to %g are accepted: give it in ml/s (1 l/min is 16.7 ml/s)",
      given.c_str(), MVS_FLOW_MIN * ml_per_m3, MVS_FLOW_MAX * ml_per_m3);
}

}  // namespace

std::array<CLI::Option *, 3> add_cost_options(CLI::App &command, CostOptions &options) {
  CLI::Option *diastole = command.add_option("--diastole", options.diastole_mmhg,
                                             "pressure difference that opens the valve, mmHg");
  diastole->type_name("MMHG")->capture_default_str()->check(
      CLI::Range(0.15, 100.0).description(""));
  CLI::Option *flow =
      command.add_option("--flow", options.flow_ml_s,
                         "flow through the open valve, ml/s, about 250: gives the gradient [not "
                         "known]");
  flow->type_name("ML/S")->check(wrong_flow, "");
  CLI::Option *septum = command.add_option(
      "--septum", options.septum,
      "file with points of the septum that faces the anterior leaflet in systole, three numbers "
      "per line, mm: gives the risk of SAM [not known]");
  septum->type_name("FILE");
  return {diastole, flow, septum};
}

CostMeter::CostMeter(const CostOptions &options) {
  options_.pressure = options.diastole_mmhg * pa_per_mmhg;
  options_.flow = options.flow_ml_s / ml_per_m3;
  words_ = text("diastole %g mmHg", options.diastole_mmhg);
  if (options.flow_ml_s > 0) words_ += text(", flow %g ml/s", options.flow_ml_s);
  if (options.septum.empty()) return;
  const PointsFile file = read_points_file(options.septum);
  words_ += ", septum " + options.septum + " with the contents " + file.hash;
  septum_ = file.points;
  for (std::array<double, 3> &point : septum_) {
    for (double &x : point) x *= 1e-3;
  }
}

mvs::Cost CostMeter::of(const mvs::Snapshot &closed, Progress *progress) const {
  mvs_cost_options options = options_;
  if (!septum_.empty()) {
    options.septum = mvs_array{septum_[0].data(), septum_.size(), 3, MVS_TYPE_F64, 0};
  }
  if (progress) {
    options.progress = Progress::callback;
    options.user = progress;
  }
  const auto measure = [&] { return with_command_units([&] { return closed.cost(options); }); };
  return septum_.empty() ? measure() : with_file_contents(measure);
}

}  // namespace cli
