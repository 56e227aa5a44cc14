// `mvs convert`: writes a valve in another file format, chosen by the ending of the name.
#include "commands/commands.h"

namespace cli {
namespace {

struct ConvertOptions {
  std::string in, out;
};

void run_convert(const ConvertOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.in);
  valve.save(options.out);
  print(console, {{"from", options.in}, {"to", options.out}, {"hash", hash_of(valve)}},
        options.in + " -> " + options.out);
}

}  // namespace

void add_convert(CLI::App &app, Console &console) {
  const auto [command, options] =
      add_command<ConvertOptions>(app, console, "convert",
                                  "write a valve in another format: .vtp for ParaView and Slicer, "
                                  ".vtm with orifice and coaptation line, .feb for FEBio",
                                  run_convert);
  command->add_option("file", options->in, "valve to read, .obj, .h5 or .inp")->required();
  command->add_option("-o,--output", options->out, "file to write, .obj, .h5, .vtp, .vtm or .feb")
      ->required();
}

}  // namespace cli
