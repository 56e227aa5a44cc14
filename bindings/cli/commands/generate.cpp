// `mvs generate`: writes a parametric valve, healthy or diseased.
#include <utility>

#include "commands/commands.h"
#include "text/command_units.h"
#include "text/output_file.h"
#include "valve/tissue.h"

namespace cli {
namespace {

struct GenerateOptions {
  std::string out;
  mvs_parametric_desc valve = {};  // lengths in mm; make_valve converts them
  std::vector<std::string> chord_factors;
  std::string shape = "healthy";
  std::string leaflet;  // empty: the default of the shape
};

struct Dimension {
  const char *option;
  double mvs_parametric_desc::*value;
  // defaults of the healthy and of the founding shape, for --help; tests/cli compares them
  double healthy, founding;
  const char *help;
};

using P = mvs_parametric_desc;
constexpr Dimension lengths[] = {
    {"--annulus-ap", &P::annulus_ap, 26, 28, "septal-lateral diameter of the annulus"},
    {"--annulus-cc", &P::annulus_cc, 35, 35, "intercommissural diameter of the annulus"},
    {"--saddle-height", &P::saddle_height, 5.5, 5.5, "height of the annular saddle"},
    {"--anterior-height", &P::anterior_height, 25, 23, "height of the anterior leaflet at A2"},
    {"--posterior-height", &P::posterior_height, 14, 13, "height of the posterior leaflet at P2"},
    {"--commissure-height", &P::commissure_height, 8, 8, "height of the leaflets at a commissure"},
    {"--thickness", &P::thickness, 0.8, 1, "thickness of the leaflets"},
    {"--papillary-depth", &P::papillary_depth, 23.5, 23.5, "papillary tip to annulus plane"},
    {"--papillary-separation", &P::papillary_separation, 20, 20, "between the two papillary tips"},
    {"--indentation-depth", &P::indentation_depth, 1, 2.5, "clefts on either side of P2"},
    {"--coaptation-depth", &P::coaptation_depth, 5, 5, "coaptation line below the annulus plane"},
};
constexpr Dimension factors[] = {
    {"--annulus-contraction", &P::annulus_contraction, 1, 1,
     "loaded over open size of the annulus"},
    {"--annulus-scale", &P::annulus_scale, 1, 1, "dilation of the loaded annulus, 1.15 for 15 %"},
    {"--chord-slack", &P::chord_slack, 1, 1, "factor on the rest length of every chord"},
};

std::string default_of(const Dimension &d) {
  return d.healthy == d.founding ? text("[%g]", d.healthy)
                                 : text("[%g; founding %g]", d.healthy, d.founding);
}

// Splits "P2/3=1.25" into name and factor; the name is empty if the text has another form.
std::pair<std::string, double> parse_chord_factor(const std::string &given) {
  const size_t sign = given.rfind('=');
  double factor = 0;
  if (sign == std::string::npos || !CLI::detail::lexical_cast(given.substr(sign + 1), factor) ||
      !(factor > 0)) {
    return {};
  }
  return {given.substr(0, sign), factor};
}

std::string check_chord_factor(const std::string &given) {
  if (!parse_chord_factor(given).first.empty()) return {};
  return "'" + given + "' is not of the form NAME=FACTOR, as in P2/3=1.25";
}

mvs::Snapshot make_valve(const GenerateOptions &options) {
  mvs_parametric_desc desc = options.valve;
  for (const Dimension &length : lengths) desc.*length.value /= 1e3;
  desc.shape = options.shape == "founding" ? MVS_SHAPE_FOUNDING : MVS_SHAPE_HEALTHY;
  desc.leaflet_law = law_of(options.leaflet);
  mvs::Simulator sim = make_sim();
  with_command_units([&] { sim.generate(desc); });
  for (const std::string &given : options.chord_factors) {
    const auto [name, factor] = parse_chord_factor(given);
    mvs_op_chord_length longer = {};
    longer.chord = sim.snapshot().find(MVS_PART_CHORD, name).id;
    longer.factor = factor;
    sim.apply(longer);
  }
  return sim.snapshot();
}

void run_generate(const GenerateOptions &options, const Console &console) {
  demand_writable_valve(options.out);
  const mvs::Snapshot valve = make_valve(options);
  valve.save(options.out);
  const Size size = size_of(valve);
  const Json object = {{"file", options.out},       {"name", mvs_snapshot_get_name(valve.get())},
                       {"vertices", size.vertices}, {"faces", size.faces},
                       {"chords", size.chords},     {"heads", size.heads},
                       {"hash", hash_of(valve)}};
  print(console, object,
        text("%s: an open valve of %zu leaflet vertices, %zu triangles, %zu chordae, %zu papillary "
             "heads",
             options.out.c_str(), size.vertices, size.faces, size.chords, size.heads));
}

}  // namespace

void add_generate(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<GenerateOptions>(
      app, console, "generate", "make a parametric mitral valve", run_generate);
  command->add_option("-o,--output", options->out, "file to write, .obj, .h5, .vtp or .vtm")
      ->required();
  command->add_option("--vertices", options->valve.vertices, "leaflet vertices, about [425]")
      ->check(positive());
  command->add_option("--chords", options->valve.chords, "chord segments, about [100; founding 80]")
      ->check(positive());
  CLI::Option *branching = command->add_flag_callback(
      "--branching", [valve = &options->valve] { valve->branching = MVS_BRANCHING_TREES; },
      "chordae branch on their way to the leaflet: the default, but for the founding shape");
  command
      ->add_flag_callback(
          "--straight", [valve = &options->valve] { valve->branching = MVS_BRANCHING_STRAIGHT; },
          "each chord is one segment")
      ->excludes(branching);
  command
      ->add_option(
          "--shape", options->shape,
          "healthy, which seals with every tissue, or founding, that of the founding model")
      ->capture_default_str()
      ->check(one_of({"healthy", "founding"}));
  add_law_option(*command, options->leaflet, "membrane; founding shape: spring");
  for (const Dimension &d : lengths) {
    command
        ->add_option(d.option, options->valve.*d.value,
                     text("%s, mm %s", d.help, default_of(d).c_str()))
        ->check(positive());
  }
  for (const Dimension &d : factors) {
    command
        ->add_option(d.option, options->valve.*d.value,
                     text("%s %s", d.help, default_of(d).c_str()))
        ->check(positive());
  }
  command
      ->add_option("--chord-factor", options->chord_factors,
                   "NAME=FACTOR: factor on the rest length of one chord, P2/3=1.25; repeatable")
      ->check(CLI::Validator(check_chord_factor, "NAME=FACTOR"))
      ->allow_extra_args(false);
}

}  // namespace cli
