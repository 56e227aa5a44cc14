// `mvs convert`: a valve from one file format to another, by the endings of the names.
#include <memory>

#include "commands.h"

namespace cli {
namespace {

void run(const std::string &in, const std::string &out, const Console &console) {
  const mvs::Snapshot valve = load(in);
  valve.save(out);
  const Json object = {{"from", in}, {"to", out}, {"hash", hash_of(valve)}};
  print(console, object, in + " -> " + out);
}

}  // namespace

void add_convert(CLI::App &app, Console &console) {
  auto files = std::make_shared<std::pair<std::string, std::string>>();
  CLI::App *command =
      add_command(app, console, "convert",
                  "write a valve in another format: .vtp for ParaView and Slicer, .feb for FEBio");
  command->add_option("file", files->first, "valve to read, .obj, .h5 or .inp")->required();
  command->add_option("-o,--output", files->second, "file to write, .obj, .h5, .vtp or .feb")
      ->required();
  command->callback([files, &console] { run(files->first, files->second, console); });
}

}  // namespace cli
