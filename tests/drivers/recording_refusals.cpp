// The driver that plays a recording: the recordings, paths and options that it refuses.
#include <sys/stat.h>
#include <clocale>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "recording_file.h"

namespace {

// The sentence with which the text is refused; empty if it is accepted.
std::string refusal(const RecordingFile &file, const std::string &text,
                    const std::map<std::string, std::string> &more = {}) {
  file.put(text);
  std::map<std::string, std::string> options = more;
  options["file"] = file.path();
  Plugin plugin("replay", options);
  const int32_t code = plugin.open();
  if (code == MVS_DRIVER_OK) return "";
  CHECK_EQ(code, MVS_DRIVER_E_OPTION);
  CHECK_EQ(plugin.device, nullptr);
  return plugin.error();
}

}  // namespace

TEST_CASE("an_invalid_recording_is_refused_with_its_line") {
  const RecordingFile file;
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
    CHECK(has(sentence, file.path() + one.where));
    CHECK(has(sentence, one.what));
  }
}

TEST_CASE("a_recording_is_read_with_any_line_ends") {
  const RecordingFile file;
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
  const RecordingFile file(short_recording);
  Plugin plugin("replay", {{"file", file.path()}, {"speed", "1.5"}});
  const int32_t code = plugin.open();
  setlocale(LC_ALL, "C");
  REQUIRE_EQ(code, MVS_DRIVER_OK);
  CHECK_EQ(at(plugin, 1).position[0], 0.01);
}

TEST_CASE("a_recording_cut_off_at_any_byte_is_refused_or_shorter") {
  const RecordingFile file;
  const std::string whole = short_recording;
  const std::size_t two_samples = whole.find("5.05");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string sentence = refusal(file, whole.substr(0, size));
    CAPTURE(size);
    // a truncated last column cannot be detected
    if (sentence.empty()) CHECK_GT(size, whole.find("5.01"));
    if (size + 1 == two_samples) CHECK_EQ(sentence, "");
    if (!sentence.empty()) CHECK(has(sentence, file.path() + ":"));
  }
}

TEST_CASE("a_recording_with_any_byte_changed_is_refused_or_finite") {
  const RecordingFile file;
  const std::string whole = short_recording;
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
  const RecordingFile pipe;
  std::filesystem::remove(pipe.path());
  REQUIRE_EQ(mkfifo(pipe.path().c_str(), 0600), 0);
  for (const std::string &path :
       {pipe.path(), std::string("/dev/zero"), std::string("/"), std::string("/no/such/file")}) {
    CAPTURE(path);
    Plugin plugin("replay", {{"file", path}});
    CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
    CHECK(has(plugin.error(), path));
    CHECK_EQ(plugin.doctor().at(0).verdict, 0);
    CHECK(plugin.list().empty());
  }
}

TEST_CASE("opening_without_a_file_is_refused") {
  Plugin plugin("replay");
  CHECK(plugin.list().empty());
  CHECK_EQ(plugin.doctor().at(0).verdict, -1);
  CHECK_EQ(plugin.open(), MVS_DRIVER_E_OPTION);
  CHECK(has(plugin.error(), "file=RECORDING"));
  const RecordingFile file(short_recording);
  CHECK_EQ(plugin.open(file.path().c_str()), MVS_DRIVER_OK);
}

TEST_CASE("invalid_options_of_a_recording_are_refused") {
  const RecordingFile file;
  const std::map<std::string, std::string> bad = {
      {"end", "never"}, {"speed", "0"},      {"speed", "-1"},  {"speed", "fast"},
      {"rate", "0.5"},  {"stiffness", "-1"}, {"force", "nan"}, {"damping", ""}};
  for (const auto &[key, value] : bad) {
    const std::string sentence = refusal(file, short_recording, {{key, value}});
    INFO(sentence);
    CHECK(has(sentence, key));
  }
  CHECK(has(refusal(file, short_recording, {{"speed", "101"}}), "from 0.001 to 100"));
}

TEST_CASE("the_shipped_recordings_are_of_a_hand_on_a_desk") {
  for (const std::string name : {"grasp_a2.txt", "push_p2.txt", "circle.txt"}) {
    CAPTURE(name);
    Plugin plugin("replay", {{"file", recordings_folder + name}, {"end", "loop"}});
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
