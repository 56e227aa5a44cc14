// verification                the studies as tests
// verification --tables DIR   the studies as tables: DIR/studies.csv and DIR/<study>.csv
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cstring>
#include <iostream>

#include "tests/verification/study.h"

using namespace mvs::core::verification;

namespace {

int print_tables(const char *folder) {
  std::vector<Study> all;
  for (const auto make : {law_studies, shear_studies, patch_studies, disc_studies, laplace_studies,
                          buckling_studies, cable_studies, bending_studies, step_studies}) {
    for (Study &study : make()) {
      std::cout << as_text(study) << std::endl;
      all.push_back(std::move(study));
    }
  }
  write_tables(all, folder);
  return 0;
}

}  // namespace

int main(int argc, char **argv) try {
  if (argc == 3 && std::strcmp(argv[1], "--tables") == 0) return print_tables(argv[2]);
  return doctest::Context(argc, argv).run();
} catch (const std::exception &error) {
  std::cerr << "verification: " << error.what() << '\n';
  return 1;
}
