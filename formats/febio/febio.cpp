// Writer of a FEBio 4.0 model that closes a valve from rest. Sections are in the order of FEBio.
#include <mvs/sim.h>

#include <cmath>
#include <numbers>

#include "formats/febio/text.h"
#include "formats/formats.h"

namespace mvs::core {
namespace {

// s: the load rises smoothly in the first half, over a physiological time, and is constant in the
// second.
constexpr double rise = 0.1, end = 0.2, step = 1e-3;
// 1/s: oscillations with a period of 0.1 s decay within one period.
constexpr double damping = 100;

// Dynamic analysis, because a buckling sheet has no continuous static path.
void write_control(FebText &out) {
  out.open("Control");
  out.leaf("analysis", "DYNAMIC");
  out.leaf("time_steps", std::to_string(std::lround(end / step)));
  out.leaf("step_size", step);
  out.open("time_stepper", "type=\"default\"");
  out.leaf("max_retries", "20");
  out.leaf("opt_iter", "15");
  out.leaf("dtmin", step / 1000);
  out.leaf("dtmax", step);
  out.leaf("aggressiveness", "0");
  out.close("time_stepper");
  out.open("solver", "type=\"solid\"");
  out.leaf("max_refs", "25");
  out.open("qn_method", "type=\"BFGS\"");
  out.leaf("max_ups", "0");  // full Newton
  out.close("qn_method");
  out.close("solver");
  out.close("Control");
}

void write_domains(const std::vector<FebDomain> &domains, FebText &out) {
  out.open("MeshDomains");
  for (const FebDomain &domain : domains) {
    out.open("ShellDomain", feb_attribute("name", domain.name) + " " +
                                feb_attribute("mat", domain.name) + " type=\"elastic-shell\"");
    out.leaf("shell_thickness", feb_number(domain.thickness, 3));
    out.leaf("shell_normal_nodal", "1");
    out.close("ShellDomain");
  }
  out.close("MeshDomains");
}

void write_boundary(FebText &out) {
  out.open("Boundary");
  for (const char axis : {'x', 'y', 'z'}) {
    out.open("bc", std::string("name=\"held ") + axis +
                       "\" node_set=\"held\" type=\"prescribed displacement\"");
    out.leaf("dof", std::string(1, axis));
    out.leaf("value", std::string("held ") + axis, "type=\"map\" lc=\"1\"");
    out.leaf("relative", "0");
    out.close("bc");
  }
  out.close("Boundary");
}

// A positive pressure acts against the normals in FEBio, and along them in libmvs.
void write_loads(double pressure, FebText &out) {
  out.open("Loads");
  out.open("surface_load", "name=\"systole\" surface=\"sheet\" type=\"pressure\"");
  out.leaf("pressure", feb_number(-pressure, -3), "lc=\"1\"");
  out.leaf("symmetric_stiffness", "1");
  out.leaf("linear", "0");
  out.close("surface_load");
  out.open("body_load", "name=\"damping\" type=\"mass damping\"");
  out.leaf("C", damping);
  out.close("body_load");
  out.close("Loads");
}

// "contact potential" (Kamensky et al. 2018, CMAME 330, 522): an energy kc / r^4 between any two
// points of the sheet closer than R_in, tapered to zero at R_out. Two flat sheets at a distance d
// press on each other with 2 pi kc / d^3, so this kc balances the load at the contact thickness.
// R0_min excludes points that are close at rest; the sources compare it with a squared distance.
void write_contact(double thickness, double pressure, FebText &out) {
  const double d = thickness * mm_per_m, outer = 1.5 * d;
  out.open("Contact");
  out.open("contact",
           "name=\"leaflets\" surface_pair=\"sheet with itself\" type=\"contact potential\"");
  out.leaf("kc", std::abs(pressure) * kpa_per_pa * d * d * d / (2 * std::numbers::pi));
  out.leaf("p", "4");
  out.leaf("R_in", d);
  out.leaf("R_out", outer);
  out.leaf("R0_min", std::max(outer, outer * outer));
  out.leaf("w_tol", "0.5");
  out.close("contact");
  out.close("Contact");
}

// A smoothstep in ten linear segments.
void write_load_curve(FebText &out) {
  out.open("LoadData");
  out.open("load_controller", "id=\"1\" name=\"rise\" type=\"loadcurve\"");
  out.leaf("interpolate", "LINEAR");
  out.leaf("extend", "CONSTANT");
  out.open("points");
  constexpr int segments = 10;
  for (int k = 0; k <= segments; ++k) {
    const double s = static_cast<double>(k) / segments;
    out.leaf("pt", feb_list(std::array{rise * s, s * s * (3 - 2 * s)}));
  }
  out.leaf("pt", feb_list(std::array{end, 1.0}));
  out.close("points");
  out.close("load_controller");
  out.close("LoadData");
}

void write_output(FebText &out) {
  out.open("Output");
  out.open("plotfile", "type=\"febio\"");
  for (const char *variable : {"displacement", "stress", "contact force"}) {
    out.leaf("var", "", feb_attribute("type", variable));
  }
  out.close("plotfile");
  out.open("logfile");
  out.leaf("node_data", "", "data=\"x;y;z\" delim=\",\" file=\"closed.csv\"");
  out.close("logfile");
  out.close("Output");
}

}  // namespace

std::string write_feb(const Model &model, const State &state) {
  const Valve &valve = model.valve;
  const Load load = state.load.pressure != 0 ? state.load : Load{MVS_SYSTOLE_PA, 1};
  const std::vector<FebDomain> domains = feb_domains(valve);
  FebText out;
  out.open("febio_spec", "version=\"4.0\"");
  out.leaf("Module", "", "type=\"solid\"");
  write_control(out);
  write_feb_materials(valve, domains, out);
  write_feb_mesh(model, domains, out);
  write_domains(domains, out);
  write_feb_mesh_data(model, domains, load.boundary_fraction, out);
  write_boundary(out);
  write_loads(load.pressure, out);
  write_contact(valve.contact_thickness, load.pressure, out);
  write_feb_springs(valve, out);
  write_load_curve(out);
  write_output(out);
  out.close("febio_spec");
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<!-- written by libmvs; mm, kPa, kg, s, mN -->\n" +
         out.take();
}

}  // namespace mvs::core
