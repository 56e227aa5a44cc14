// The same headers in C++.
#include <mvs/mvs.h>

#include <cstdio>

int main() {
  mvs_sim *sim = nullptr;
  if (mvs_create(nullptr, &sim) != MVS_OK) {
    std::fprintf(stderr, "%s\n", mvs_last_error()->message);
    return 1;
  }
  mvs_destroy(sim);
  return 0;
}
