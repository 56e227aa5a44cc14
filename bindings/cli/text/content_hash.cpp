#include "text/content_hash.h"

#include <cstdint>

#include "text/console.h"

namespace cli {

std::string content_hash(std::string_view bytes) {
  uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return text("%016llx", static_cast<unsigned long long>(hash));
}

}  // namespace cli
