// The driver that plays a recording: the samples it plays, and the recordings it refuses.
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "plugin.h"

namespace {

using Options = std::map<std::string, std::string>;

// A temporary file, removed by its owner's destructor.
class Scratch {
 public:
  explicit Scratch(const std::string &text = {}) {
    static int count = 0;
    const auto folder = std::filesystem::temp_directory_path();
    path_ = folder / ("mvs_replay_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    put(text);
  }
  ~Scratch() { std::filesystem::remove(path_); }
  Scratch(const Scratch &) = delete;
  Scratch &operator=(const Scratch &) = delete;

  void put(const std::string &text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// Starts at 5 s, with samples 10, 40 and 50 ms apart; turns a quarter about z in the first part.
const char *const kRecording =
    "mvs-recording 1\n"
    "# for tests\n"
    "device Test stylus\n"
    "force 3.5\n"
    "rate 500\n"
    "\n"
    "5.00 0.01 0 -0.02  1 0 0 0  0 0\n"
    "5.01 0.02 0 -0.02  -0.70710678118654757 0 0 -0.70710678118654757  1 0.2 # grasp\n"
    "5.05 0.02 0.04 -0.02  0.70710678118654757 0 0 0.70710678118654757  1 0.4\n"
    "5.10 0.02 0.04 0.03  0.70710678118654757 0 0 0.70710678118654757  2 0.4\n";

const char *const kFolder = MVS_SOURCE_DIR "/haptic_drivers/replay/trajectories/";
const double kRootHalf = std::sqrt(0.5);

mvs_driver_state at(Plugin &plugin, double seconds) {
  mvs_driver_state state;
  REQUIRE_EQ(plugin.read(static_cast<uint64_t>(std::llround(seconds * 1e9)), state), MVS_DRIVER_OK);
  return state;
}

// The sentence with which the text is refused; empty if it is accepted.
std::string refusal(const Scratch &file, const std::string &text, const Options &more = {}) {
  file.put(text);
  Options options = more;
  options["file"] = file.path();
  Plugin plugin("replay", options);
  const int32_t code = plugin.open();
  if (code == MVS_DRIVER_OK) return "";
  CHECK_EQ(code, MVS_DRIVER_E_OPTION);
  CHECK_EQ(plugin.device, nullptr);
  return plugin.error();
}

bool contains(const std::string &text, const std::string &part) {
  return text.find(part) != text.npos;
}

}  // namespace

TEST_CASE("a_recording_is_interpolated_linearly_between_its_samples") {
  const Scratch file(kRecording);
  Plugin plugin("replay", {{"file", file.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 1).position[0], 0.01);  // before start() it waits at its beginning
  REQUIRE_EQ(plugin.api.start(plugin.device), MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 100).position[0], 0.01);  // and begins with the first read after it

  // the clock counts nanoseconds, and 5.01 - 5 is rounded
  const double tolerance = 1e-9;
  const mvs_driver_state early = at(plugin, 100.005);
  CHECK(std::abs(early.position[0] - 0.015) < tolerance);
  CHECK(std::abs(early.velocity[0] - 1) < tolerance);
  CHECK((early.flags & MVS_DRIVER_FLAG_VELOCITY) != 0);
  CHECK_EQ(early.buttons, 0);
  CHECK(std::abs(early.gripper - 0.1) < tolerance);
  // an eighth of a turn: the file has the quarter with the other sign, which is the same turn
  CHECK(std::abs(std::abs(early.orientation[0]) - std::cos(std::atan(1) / 2)) < tolerance);
  CHECK(std::abs(early.orientation[0] * early.orientation[3] - kRootHalf / 2) < tolerance);

  const mvs_driver_state middle = at(plugin, 100.03);
  CHECK_EQ(middle.position[0], 0.02);
  CHECK(std::abs(middle.position[1] - 0.02) < tolerance);
  CHECK(std::abs(middle.velocity[1] - 1) < tolerance);
  CHECK_EQ(middle.buttons, 1);
  CHECK(std::abs(std::abs(middle.orientation[3]) - kRootHalf) < tolerance);
  CHECK(std::abs(at(plugin, 100.075).velocity[2] - 1) < tolerance);
}

TEST_CASE("a_recording_plays_the_same_at_any_rate") {
  const std::string file = std::string(kFolder) + "grasp_a2.txt";
  Plugin fast("replay", {{"file", file}}), slow("replay", {{"file", file}});
  REQUIRE_EQ(fast.open(), MVS_DRIVER_OK);
  REQUIRE_EQ(slow.open(), MVS_DRIVER_OK);
  fast.api.start(fast.device);
  slow.api.start(slow.device);
  for (int ms = 0; ms < 12000; ++ms) {
    const mvs_driver_state one = at(fast, 1 + ms * 1e-3);
    if (ms % 7) continue;
    const mvs_driver_state other = at(slow, 1 + ms * 1e-3);
    for (int k = 0; k < 3; ++k) CHECK_EQ(one.position[k], other.position[k]);
    CHECK_EQ(one.buttons, other.buttons);
  }
}

TEST_CASE("a_recording_stays_loops_or_stops_at_its_end") {
  const Scratch file(kRecording);
  const auto begun = [&](Plugin &plugin) {
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    plugin.api.start(plugin.device);
    at(plugin, 1);
  };
  Plugin stay("replay", {{"file", file.path()}});
  begun(stay);
  CHECK_EQ(at(stay, 2).position[2], 0.03);
  CHECK_EQ(at(stay, 2.1).velocity[2], 0);
  const uint64_t before = at(stay, 2.2).sequence;
  CHECK_GT(at(stay, 2.3).sequence, before);  // it is at rest, not lost

  Plugin loop("replay", {{"file", file.path()}, {"end", "loop"}});
  begun(loop);
  CHECK(std::abs(at(loop, 1 + 7 * 0.1 + 0.005).position[0] - 0.015) < 1e-9);

  Plugin stop("replay", {{"file", file.path()}, {"end", "stop"}});
  begun(stop);
  at(stop, 1.099);
  mvs_driver_state state;
  CHECK_EQ(stop.read(1101000000, state), MVS_DRIVER_E_END);
  CHECK(contains(stop.error(), file.path() + " is over"));
  CHECK_EQ(stop.read(1102000000, state), MVS_DRIVER_E_END);
  stop.api.start(stop.device);  // starts from its beginning again
  CHECK_EQ(at(stop, 2).position[0], 0.01);
}

TEST_CASE("a_recording_plays_faster_on_request") {
  const Scratch file(kRecording);
  Plugin plugin("replay", {{"file", file.path()}, {"speed", "2"}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  plugin.api.start(plugin.device);
  at(plugin, 1);
  CHECK(std::abs(at(plugin, 1.015).position[1] - 0.02) < 1e-9);
  CHECK(std::abs(at(plugin, 1.016).velocity[1] - 2) < 1e-9);
}

TEST_CASE("a_recording_describes_its_device") {
  const Scratch file(kRecording);
  Plugin plugin("replay", {{"file", file.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  const mvs_driver_info info = plugin.info();
  CHECK_EQ(std::string(info.model), "Test stylus");
  CHECK_EQ(info.peak_force, 3.5);
  CHECK_EQ(info.max_stiffness, 0);  // unknown
  CHECK_EQ(info.rate, 500);
  CHECK_EQ(info.freedoms_in, 6);
  CHECK_EQ(info.freedoms_out, 3);
  CHECK_EQ(info.has_gripper, 1);
  CHECK_EQ(info.buttons, 2);
  // unknown: around zero, 20 mm beyond the farthest sample
  CHECK_EQ(info.workspace_min[2], -0.05);
  CHECK_EQ(info.workspace_max[2], 0.05);

  Plugin told("replay",
              {{"file", file.path()}, {"force", "0"}, {"device", "Mouse"}, {"rate", "60"}});
  REQUIRE_EQ(told.open(), MVS_DRIVER_OK);
  CHECK_EQ(told.info().freedoms_out, 0);
  CHECK_EQ(told.info().rate, 60);
  CHECK_EQ(std::string(told.info().model), "Mouse");
}

TEST_CASE("a_force_beyond_the_device_saturates_and_an_invalid_one_is_refused") {
  const Scratch file(kRecording);
  Plugin plugin("replay", {{"file", file.path()}});
  REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
  plugin.api.start(plugin.device);
  CHECK_EQ(plugin.write(0, 3.5, 0), MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 1).flags & MVS_DRIVER_FLAG_SATURATED, 0);
  CHECK_EQ(plugin.write(0, 3.6, 0), MVS_DRIVER_OK);
  CHECK((at(plugin, 2).flags & MVS_DRIVER_FLAG_SATURATED) != 0);
  CHECK_EQ(plugin.write(0, std::nan(""), 0), MVS_DRIVER_E_FAULT);
  CHECK_EQ(at(plugin, 3).flags & MVS_DRIVER_FLAG_FORCE_ON, 0);
}

TEST_CASE("an_invalid_recording_is_refused_with_its_line") {
  const Scratch file;
  const std::string head = "mvs-recording 1\n";
  const std::string first = "0 0 0 0 1 0 0 0 0 0\n", second = "1 0 0 0 1 0 0 0 0 0\n";
  const struct {
    std::string text, where, what;
  } bad[] = {
      {"", ":0: ", "is empty"},
      {"\n", ":1: ", "is not a recording"},
      {"v 0 0 0\n", ":1: ", "is not a recording"},
      {"mvs-recording 2\n" + first + second, ":1: ", "version"},
      {head, ":1: ", "fewer than two samples"},
      {head + first, ":2: ", "fewer than two samples"},
      {head + first + "0 0 0 0 1 0 0 0 0 0\n", ":3: ", "time must grow"},
      {head + second + first, ":3: ", "time must grow"},
      {head + first + "1e-9 0 0 0 1 0 0 0 0 0\n", ":3: ", "time must grow"},
      {head + "0 0 0 0 1 0 0 0 0\n", ":2: ", "has 9 columns"},
      {head + first + "1 0 0 0 1 0 0 0 0 0 0\n", ":3: ", "has 11 columns"},
      {head + first + "1 nan 0 0 1 0 0 0 0 0\n", ":3: ", "\"nan\" is not a finite number"},
      {head + first + "inf 0 0 0 1 0 0 0 0 0\n", ":3: ", "a sample begins with its time"},
      {head + first + "1 1e999 0 0 1 0 0 0 0 0\n", ":3: ", "\"1e999\" is not a finite number"},
      {head + first + "1 0,5 0 0 1 0 0 0 0 0\n", ":3: ", "\"0,5\" is not a finite number"},
      {head + first + "1 0.5x 0 0 1 0 0 0 0 0\n", ":3: ", "\"0.5x\" is not a finite number"},
      {head + first + "1 0x1p3 0 0 1 0 0 0 0 0\n", ":3: ", "\"0x1p3\" is not a finite number"},
      {head + first + "1 \x01\x02 0 0 1 0 0 0 0 0\n", ":3: ", "\"??\" is not a finite number"},
      {head + first + "1 11 0 0 1 0 0 0 0 0\n", ":3: ", "\"11\" is out of range"},
      {head + first + "1 0 0 0 0 0 0 0 0 0\n", ":3: ", "not of length 1"},
      {head + first + "1 0 0 0 1 0 0 0.1 0 0\n", ":3: ", "not of length 1"},
      {head + first + "1 0 0 0 1 0 0 0 -1 0\n", ":3: ", "buttons are a sum"},
      {head + first + "1 0 0 0 1 0 0 0 4294967296 0\n", ":3: ", "buttons are a sum"},
      {head + first + "force 3\n" + second, ":3: ", "before the first sample"},
      {head + "colour red\n" + first + second, ":2: ", "\"colour\" is not known"},
      {head + "force\n" + first + second, ":2: ", "force takes one number"},
      {head + "force -1\n" + first + second, ":2: ", "out of range"},
      {head + "buttons 33\n" + first + second, ":2: ", "buttons takes a count"},
      {head + "workspace 0 0 0 1 1\n" + first + second, ":2: ", "takes six numbers"},
      {head + "workspace 0 0 0 1 1 0\n" + first + second, ":2: ", "inside out"},
      {head + "device " + std::string(64, 'x') + "\n" + first + second, ":2: ", "63 bytes"},
  };
  for (const auto &one : bad) {
    CAPTURE(one.text);
    const std::string sentence = refusal(file, one.text);
    CAPTURE(sentence);
    CHECK(contains(sentence, file.path() + one.where));
    CHECK(contains(sentence, one.what));
  }
}

TEST_CASE("a_recording_is_read_with_any_line_ends") {
  const Scratch file;
  const std::string text = "mvs-recording 1\n0 0 0 0 1 0 0 0 0 0\n1 0 0 0 1 0 0 0 0 0";
  std::string with_returns;
  for (const char c : text) with_returns += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK_EQ(refusal(file, text), "");
  CHECK_EQ(refusal(file, text + "\n"), "");
  CHECK_EQ(refusal(file, text + "\n\n#\n"), "");
  CHECK_EQ(refusal(file, with_returns), "");
  CHECK_EQ(refusal(file, with_returns + "\r\n"), "");
}

TEST_CASE("a_recording_is_read_in_any_locale") {
  const char *const comma = setlocale(LC_ALL, "de_DE.UTF-8") ? "de_DE.UTF-8" : nullptr;
  if (!comma) MESSAGE("skipped: this machine has no locale de_DE.UTF-8");
  const Scratch file(kRecording);
  Plugin plugin("replay", {{"file", file.path()}, {"speed", "1.5"}});
  const int32_t code = plugin.open();
  setlocale(LC_ALL, "C");
  REQUIRE_EQ(code, MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 1).position[0], 0.01);
}

TEST_CASE("a_recording_cut_off_at_any_byte_is_refused_or_shorter") {
  const Scratch file;
  const std::string whole = kRecording;
  const std::size_t two_samples = whole.find("5.05");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string sentence = refusal(file, whole.substr(0, size));
    CAPTURE(size);
    // a truncated last column cannot be detected
    if (sentence.empty()) CHECK_GT(size, whole.find("5.01"));
    if (size + 1 == two_samples) CHECK_EQ(sentence, "");
    if (!sentence.empty()) CHECK(contains(sentence, file.path() + ":"));
  }
}

TEST_CASE("a_recording_with_any_byte_changed_is_refused_or_finite") {
  const Scratch file;
  const std::string whole = kRecording;
  for (std::size_t k = 0; k < whole.size(); ++k)
    for (const char other : {'\0', ' ', '\n', '-', '9', 'e', '\xff'}) {
      std::string text = whole;
      text[k] = other;
      file.put(text);
      Plugin plugin("replay", {{"file", file.path()}});
      if (plugin.open() != MVS_DRIVER_OK) continue;
      plugin.api.start(plugin.device);
      for (int ms = 0; ms < 120; ms += 11) {
        const mvs_driver_state state = at(plugin, 1 + ms * 1e-3);
        double sum = state.gripper;
        for (int i = 0; i < 3; ++i) sum += state.position[i] + state.velocity[i];
        for (int i = 0; i < 4; ++i) sum += state.orientation[i];
        REQUIRE(std::isfinite(sum));
      }
    }
}

TEST_CASE("paths_that_are_not_files_are_refused_at_once") {
  const Scratch pipe;
  std::filesystem::remove(pipe.path());
  REQUIRE_EQ(mkfifo(pipe.path().c_str(), 0600), 0);
  for (const std::string &path :
       {pipe.path(), std::string("/dev/zero"), std::string("/"), std::string("/no/such/file")}) {
    CAPTURE(path);
    Plugin plugin("replay", {{"file", path}});
    CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
    CHECK(contains(plugin.error(), path));
    CHECK_EQ(plugin.doctor().at(0).verdict, 0);
    CHECK(plugin.list().empty());
  }
}

TEST_CASE("opening_without_a_file_is_refused") {
  Plugin plugin("replay");
  CHECK(plugin.list().empty());
  CHECK_EQ(plugin.doctor().at(0).verdict, -1);
  CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
  CHECK(contains(plugin.error(), "file=RECORDING"));
  const Scratch file(kRecording);
  CHECK_EQ(plugin.open(file.path().c_str()), MVS_DRIVER_OK);
}

TEST_CASE("invalid_options_of_a_recording_are_refused") {
  const Scratch file;
  const Options bad = {{"end", "never"}, {"speed", "0"},      {"speed", "-1"},  {"speed", "fast"},
                       {"rate", "0.5"},  {"stiffness", "-1"}, {"force", "nan"}, {"damping", ""}};
  for (const auto &[key, value] : bad) {
    const std::string sentence = refusal(file, kRecording, {{key, value}});
    INFO(sentence);
    CHECK(contains(sentence, key));
  }
  CHECK(contains(refusal(file, kRecording, {{"speed", "101"}}), "from 0.001 to 100"));
}

TEST_CASE("the_shipped_recordings_are_of_a_hand_on_a_desk") {
  for (const std::string name : {"grasp_a2.txt", "push_p2.txt", "circle.txt"}) {
    CAPTURE(name);
    Plugin plugin("replay", {{"file", kFolder + name}, {"end", "loop"}});
    for (const auto &finding : plugin.doctor()) CHECK_EQ(finding.verdict, 1);  // it may loop
    REQUIRE_EQ(plugin.open(), MVS_DRIVER_OK);
    plugin.api.start(plugin.device);
    uint32_t pressed = 0;
    double least = 1, most = -1;
    for (int ms = 0; ms < 15000; ms += 5) {
      const mvs_driver_state state = at(plugin, 1 + ms * 1e-3);
      pressed |= state.buttons;
      least = std::min(least, state.position[1]);
      most = std::max(most, state.position[1]);
      for (int k = 0; k < 3; ++k) {
        CHECK_LE(std::abs(state.position[k]), 0.06);
        CHECK_LT(std::abs(state.velocity[k]), 0.1);  // m/s: a careful hand
      }
    }
    CHECK_EQ(pressed, name == "grasp_a2.txt" ? 1 : 0);
    CHECK_GT(most - least, 0.02);
  }
}

TEST_CASE("a_loop_with_a_jump_causes_a_warning") {
  const Scratch file(kRecording);
  Plugin plugin("replay", {{"file", file.path()}, {"end", "loop"}});
  const auto findings = plugin.doctor();
  REQUIRE_EQ(findings.size(), 2);
  CHECK_EQ(findings[0].verdict, 1);
  CHECK_EQ(findings[1].verdict, -1);
}

TEST_CASE("two_recordings_play_side_by_side") {
  const Scratch file(kRecording);
  Plugin one("replay", {{"file", file.path()}}), two("replay", {{"file", file.path()}});
  REQUIRE_EQ(one.open(), MVS_DRIVER_OK);
  REQUIRE_EQ(two.open(), MVS_DRIVER_OK);
  one.api.start(one.device);
  two.api.start(two.device);
  at(one, 1);
  CHECK_EQ(at(two, 2).position[0], 0.01);
  CHECK_EQ(at(one, 2).position[2], 0.03);
  one.close();
  CHECK_EQ(at(two, 3).position[2], 0.03);
}
