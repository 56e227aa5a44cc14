// The C++ handles: they free, share, throw, and show what C shows.
#include <cmath>
#include <cstdio>
#include <mvs/experimental.hpp>
#include <type_traits>

#include "tests/founding.h"

namespace {

int failures = 0;

void check(bool condition, const char *what) {
  if (condition) return;
  ++failures;
  std::printf("not so: %s\n", what);
}

void handles_move_and_snapshots_are_shared() {
  static_assert(!std::is_copy_constructible<mvs::Simulator>::value, "one owner");
  static_assert(std::is_nothrow_move_constructible<mvs::Simulator>::value, "moves");
  mvs::Simulator first;
  first.generate(founding_valve());
  mvs::Simulator sim = std::move(first);
  const mvs::Snapshot one = sim.snapshot();
  mvs::Snapshot two = one, three = std::move(two);
  two = three;
  sim = mvs::Simulator();
  check(one.hash() == two.hash() && one.get() == three.get(), "copies show one snapshot");
}

void failures_are_thrown_with_code_and_part() {
  try {
    mvs::Simulator().snapshot();
    check(false, "an empty simulator has no snapshot");
  } catch (const mvs::Error &error) {
    check(error.code() == MVS_E_STATE, "the code of C");
    check(error.part() == "sim" && error.line() == 0, "part and line of C");
    check(std::string(error.what()) == mvs_last_error()->message, "the sentence of C");
  }
}

void regions_and_openings_are_lists() {
  mvs::Simulator sim;
  sim.generate();
  const mvs::Snapshot open = sim.snapshot();
  double area = 0;
  for (const mvs_orifice_part &part : open.orifice_parts()) area += part.area;
  check(area > 0 && std::abs(area - open.measure().regurgitant_orifice_area) < 1e-15,
        "the parts of an open valve add up");
  check(open.regions().size() == open.parts(MVS_PART_SCALLOP).size() + 2,
        "scallops and two commissures");
}

void views_know_their_type() {
  mvs::Simulator sim;
  sim.generate(founding_valve());
  const mvs::Snapshot snapshot = sim.snapshot();
  const mvs::View<double> x = snapshot.view<double>(MVS_ARRAY_NODE_POSITION);
  check(x.rows() > 0 && x.components() == 3, "positions are rows of three");
  check(x.end() - x.begin() == static_cast<std::ptrdiff_t>(3 * x.rows()), "all of them");
  check(x.row(1) == x.data() + 3, "packed");
  check(snapshot.view<std::uint32_t>(MVS_ARRAY_TRIANGLE_NODES).rows() > 0, "triangles");
  check(snapshot.view<std::uint8_t>(MVS_ARRAY_NODE_KIND).rows() == x.rows(), "kinds");
  check(snapshot.view<std::uint64_t>(MVS_ARRAY_CHORD_ID).rows() > 0, "ids");
  try {
    snapshot.view<double>(MVS_ARRAY_TRIANGLE_NODES);
    check(false, "an index is no double");
  } catch (const std::invalid_argument &) {
  }
}

void tools_are_added_moved_told_and_removed() {
  mvs::Simulator sim;
  sim.generate(founding_valve());
  mvs_tool_desc ball = {};
  ball.kind = MVS_TOOL_KIND_BALL;
  ball.position[2] = 0.05;
  const mvs_id tool = sim.add_tool(ball);
  sim.move_tool(tool, {0, 0, 0.049});
  sim.step();
  check(sim.tool(tool).position[2] == 0.049, "the hand has moved");
  check(mvs::tools_of(sim.snapshot()).size() == 1, "one tool");
  sim.remove_tool(tool);
  check(mvs::tools_of(sim.snapshot()).empty(), "no tool");
}

// With the driver template, where drivers are built.
void devices_are_found_opened_and_turned() {
  try {
    const mvs::Device none({0, MVS_CLOCK_REAL, "nowhere", nullptr, nullptr, 0, nullptr, nullptr});
    check(false, "there is no such driver");
  } catch (const mvs::Error &error) {
    check(error.code() == MVS_E_IO, "the code of C");
  }
  for (const mvs::Driver &driver : mvs::drivers()) {
    if (driver.name != "template") continue;
    check(!mvs::findings_of(driver.path).empty(), "it has a doctor");
    const std::vector<mvs::FoundDevice> found = mvs::devices_of(driver.name);
    check(found.size() == 1, "and one device");
    mvs_device_desc desc = {};
    desc.clock = MVS_CLOCK_VIRTUAL;
    desc.driver = driver.path.c_str();
    desc.device = found[0].name.c_str();
    mvs::Device first(desc);
    mvs::Device device = std::move(first);
    mvs_device_limits limits = device.limits();
    limits.force = 0.5;
    device.set_limits(limits);
    check(device.limits().force == 0.5 && device.info().peak_force >= 0.5, "limits");
    device.set_view(device.view());
    device.set_hand(device.hand());
    device.start();
    device.arm();
    device.advance(0.01);
    std::uint64_t lost = 0;
    check(device.take_samples(lost).size() == 10 && lost == 0, "ticks");
    mvs::Simulator sim;
    sim.generate(founding_valve());
    check(device.sync(sim.get()).tool == 0, "an empty hand");
    device.cut();
    device.advance(0.001);
    check(device.state().cause == MVS_CAUSE_SOFTWARE, "cut");
    device.stop();
  }
}

void a_valve_is_worked_on_from_load_to_file() {
  mvs::Simulator sim;
  sim.generate(founding_valve());
  const mvs::Snapshot open = sim.snapshot();
  sim.set_load(100, 0.5);
  check(sim.load().pressure == 100, "the load is read back");
  mvs_settle_options few = {};
  few.max_iterations = 2;
  sim.settle(few);
  sim.step();
  check(sim.stats().iterations == 1, "statistics of the step");
  const mvs::Snapshot now = sim.snapshot();
  check(now.load().boundary_fraction == 0.5 && now.name() == open.name(), "state and name");
  check(now.measure().annulus_perimeter > 0, "measures");
  check(open.compare(open).same_mesh == 1, "comparison");
  const std::vector<mvs_part> leaflets = now.parts(MVS_PART_LEAFLET);
  check(!leaflets.empty() && now.find(MVS_PART_LEAFLET, leaflets[0].name).id == leaflets[0].id,
        "parts");
  const std::array<double, 12> frame = now.frame();
  check(now.section({frame[0], frame[1], frame[2]}, {frame[3], frame[4], frame[5]}).size() > 1,
        "a cut through the middle");
  check(now.section({1, 1, 1}, {1, 1, 1}).empty(), "a cut beside the valve");
  const std::string bytes = now.save_memory();
  mvs::Simulator other;
  other.load_memory(bytes);
  check(other.snapshot().hash() == now.hash(), "saved and loaded");
  now.save("handles_test.obj");
  other.load_file("handles_test.obj");
  std::remove("handles_test.obj");
  other.restore(open);
  check(other.snapshot().hash() == open.hash(), "restored");
}

void operations_are_applied_undone_and_listed() {
  mvs::Simulator sim;
  sim.generate(founding_valve());
  const mvs::Snapshot open = sim.snapshot();
  mvs_op_chord_length shorter = {};
  shorter.chord = open.find(MVS_PART_CHORD, "P2/3").id;
  shorter.factor = 0.75;
  sim.check(shorter);
  check(sim.snapshot().hash() == open.hash(), "check changes nothing");
  sim.begin_group("repair");
  check(sim.apply(shorter) == 0, "a shortened chord is nothing new");
  mvs_op_chord_add add = {};
  add.head = open.find(MVS_PART_HEAD, "PM1").id;
  add.site = {MVS_SITE_ANATOMICAL, 0, open.find(MVS_PART_SCALLOP, "P2").id, {0.5, 0.9, 0}};
  check(sim.apply(add) != 0, "an added chord is");
  sim.end_group();
  sim.set_checkpoint("repaired");
  const mvs::Snapshot repaired = sim.snapshot();
  sim.undo();
  check(sim.snapshot().hash() == open.hash(), "the group is undone");
  sim.redo();
  check(sim.snapshot().hash() == repaired.hash(), "and redone");
  sim.undo();
  const mvs::History undone = sim.snapshot().history();
  check(undone.done.empty() && undone.undone.size() == 2, "two operations can be redone");
  sim.restore_checkpoint("repaired");
  const mvs::History history = sim.snapshot().history();
  check(history.done.size() == 2 && history.done[0].kind == MVS_OP_CHORD_LENGTH, "kinds");
  check(history.checkpoints == std::vector<std::string>{"repaired"}, "checkpoints");
  try {
    shorter.factor = -1;
    sim.apply(&shorter.op);
    check(false, "an operation without size and kind is none");
  } catch (const mvs::Error &error) {
    check(error.code() == MVS_E_ARGUMENT, "what C says");
  }
}

void kinds_of_operations_describe_themselves() {
  const std::vector<mvs::OpKind> kinds = mvs::op_kinds();
  check(kinds.size() == mvs_get_op_count() && kinds.size() >= 7, "all kinds");
  check(std::string(kinds[0].info.name) == "chord_length", "in order");
  check(std::string(kinds[0].fields.at(0).name) == "chord", "with their fields");
}

void surfaces_are_read_with_names_and_arrays() {
  const char *const path = "handles_test.csv";
  std::FILE *file = std::fopen(path, "wb");
  check(file != nullptr, "a file to write");
  if (!file) return;
  std::fputs("label,r,a,s\nAL,1,2,3\nPM,4,5,6\n", file);
  std::fclose(file);
  mvs_surface_file_options options = {};
  options.unit = MVS_LENGTH_UNIT_MM;
  mvs::SurfaceFile first(path, options);
  const mvs::SurfaceFile points = std::move(first);
  check(points.points().rows() == 2 && points.points().row(1)[0] == 4e-3, "metres");
  check(points.triangles().rows() == 0 && points.arrays().empty(), "no triangles");
  check(points.names() == std::vector<std::string>{"AL", "PM"}, "names");
  check(points.info().frame == MVS_PATIENT_FRAME_RAS, "the frame of the columns");
  std::remove(path);
  try {
    const mvs::SurfaceFile missing(path, options);
    check(false, "the file is gone");
  } catch (const mvs::Error &error) {
    check(error.code() == MVS_E_IO, "the code of C");
  }
}

void run() {
  handles_move_and_snapshots_are_shared();
  failures_are_thrown_with_code_and_part();
  regions_and_openings_are_lists();
  views_know_their_type();
  tools_are_added_moved_told_and_removed();
  devices_are_found_opened_and_turned();
  a_valve_is_worked_on_from_load_to_file();
  operations_are_applied_undone_and_listed();
  kinds_of_operations_describe_themselves();
  surfaces_are_read_with_names_and_arrays();
}

}  // namespace

int main() {
  try {
    run();
  } catch (const std::exception &error) {
    std::printf("%s\n", error.what());
    ++failures;
  }
  std::printf("handles: %s\n", failures ? "FAILED" : "ok");
  return failures ? 1 : 0;
}
