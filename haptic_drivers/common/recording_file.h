// Strict parser of recording files (format: replay/README.md).
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/recording.h"

namespace driver {

class RecordingFile {
 public:
  // Throws a Refusal that names the file and the line.
  static Recording load(const std::string &path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status))
      refuse(MVS_DRIVER_E_OPTION, path + ": there is no such recording");
    // open() of a pipe or a device could block
    if (!std::filesystem::is_regular_file(status))
      refuse(MVS_DRIVER_E_OPTION, path + " is not a file");
    const auto size = std::filesystem::file_size(path, error);
    if (error || size > kMostBytes)
      refuse(MVS_DRIVER_E_OPTION, path + " is longer than 256 MiB: cut the recording into parts");
    std::ifstream in(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in) refuse(MVS_DRIVER_E_PERMISSION, path + " cannot be read: see who may read it");
    return RecordingFile(path).parse(text);
  }

 private:
  static constexpr std::size_t kMostBytes = std::size_t(256) << 20;
  static constexpr std::size_t kMostSamples = 1000000;
  static constexpr double kMostTime = 1e6, kLeastStep = 1e-6;  // s
  static constexpr double kFarthest = 10;                      // m
  using Words = std::vector<std::string_view>;

  explicit RecordingFile(std::string path) : path_(std::move(path)) {}

  Recording parse(std::string_view text) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++line_;
      line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (line_ == 0) bad("is empty: a recording begins with \"mvs-recording 1\"");
    if (samples_.size() < 2) bad("has fewer than two samples: is it cut off?");
    return Recording(std::move(source_), std::move(samples_));
  }

  void line(std::string_view text) {
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    const std::string_view whole = text.substr(0, text.find('#'));
    const Words words = split(whole);
    if (line_ == 1) {
      if (words.size() != 2 || words[0] != "mvs-recording")
        bad("is not a recording: its first line must be \"mvs-recording 1\"");
      if (words[1] != "1") bad("is of a version that this driver does not know: it reads 1");
    } else if (!words.empty()) {
      const char first = words[0][0];
      if (first >= 'a' && first <= 'z')
        header(words);
      else
        sample(words);
    }
  }

  void header(const Words &words) {
    if (!samples_.empty())
      bad("a sample begins with its time; lines about the device stand before the first sample");
    const std::string_view key = words[0];
    if (key == "device") {
      for (std::size_t k = 1; k < words.size(); ++k)
        source_.device += (k > 1 ? " " : "") + std::string(words[k]);
      if (source_.device.size() > 63) bad("a device's name has at most 63 bytes");
    } else if (key == "workspace") {
      workspace(words);
    } else if (double *const place = number_of(key)) {
      if (words.size() != 2) bad(std::string(key) + " takes one number");
      *place = number(words[1], 0, 1e6);
    } else if (key == "buttons") {
      const auto buttons = words.size() == 2 ? count(words[1]) : std::nullopt;
      if (!buttons || *buttons > 32) bad("buttons takes a count from 0 to 32");
      source_.buttons = *buttons;
    } else {
      bad("\"" + shown(key) + "\" is not known: device, force, continuous_force, stiffness, " +
          "damping, rate, workspace or buttons");
    }
  }

  double *number_of(std::string_view key) {
    if (key == "force") return &source_.force;
    if (key == "continuous_force") return &source_.continuous_force;
    if (key == "stiffness") return &source_.stiffness;
    if (key == "damping") return &source_.damping;
    if (key == "rate") return &source_.rate;
    return nullptr;
  }

  void workspace(const Words &words) {
    if (words.size() != 7) bad("workspace takes six numbers, smallest corner first");
    for (int k = 0; k < 6; ++k) source_.workspace[k] = number(words[k + 1], -kFarthest, kFarthest);
    for (int k = 0; k < 3; ++k)
      if (source_.workspace[k] >= source_.workspace[k + 3])
        bad("the workspace is turned inside out: its smallest corner comes first");
  }

  void sample(const Words &words) {
    if (words.size() != 10)
      bad("has " + std::to_string(words.size()) + " columns, and a sample has 10: time, " +
          "position x y z, orientation w x y z, buttons, gripper");
    if (samples_.size() == kMostSamples) bad("a recording has at most a million samples");
    Recording::Sample s;
    s.time = number(words[0], -kMostTime, kMostTime);
    // bounds the velocity
    if (!samples_.empty() && s.time < samples_.back().time + kLeastStep)
      bad("time must grow by at least a microsecond from sample to sample");
    for (int k = 0; k < 3; ++k) s.pose.position[k] = number(words[1 + k], -kFarthest, kFarthest);
    orientation(words, s.pose.orientation);
    const auto buttons = count(words[8]);
    if (!buttons) bad("\"" + shown(words[8]) + "\": buttons are a sum of 1, 2, 4, ... below 2^32");
    s.pose.buttons = *buttons;
    s.pose.gripper = number(words[9], -7, 7);
    samples_.push_back(s);
  }

  void orientation(const Words &words, std::array<double, 4> &q) const {
    double norm = 0;
    for (int k = 0; k < 4; ++k) {
      q[k] = number(words[4 + k], -2, 2);
      norm += q[k] * q[k];
    }
    norm = std::sqrt(norm);
    // allows for quaternions rounded to three digits
    if (std::abs(norm - 1) > 2e-3) bad("the orientation w x y z is not of length 1");
    for (double &k : q) k /= norm;
  }

  double number(std::string_view word, double least, double most) const {
    const auto value = decimal(word);
    if (!value) bad("\"" + shown(word) + "\" is not a finite number");
    if (*value < least || *value > most) bad("\"" + shown(word) + "\" is out of range");
    return *value;
  }

  static Words split(std::string_view text) {
    Words words;
    for (;;) {
      const std::size_t begin = text.find_first_not_of(" \t");
      if (begin == text.npos || words.size() > 64) return words;
      text.remove_prefix(begin);
      const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
      words.push_back(text.substr(0, end));
      text.remove_prefix(end);
    }
  }

  // Returns a word for an error message, with unprintable bytes replaced.
  static std::string shown(std::string_view word) {
    std::string out(word.substr(0, 32));
    for (char &c : out)
      if (c < ' ' || c > '~') c = '?';
    return out;
  }

  [[noreturn]] void bad(const std::string &what) const {
    refuse(MVS_DRIVER_E_OPTION, path_ + ":" + std::to_string(line_) + ": " + what);
  }

  std::string path_;
  std::size_t line_ = 0;
  Source source_;
  std::vector<Recording::Sample> samples_;
};

}  // namespace driver
