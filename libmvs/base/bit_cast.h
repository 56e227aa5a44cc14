// std::bit_cast, which standard libraries of 2022 lack (libc++ 14, that of Debian's emscripten).
#pragma once

#include <type_traits>

namespace mvs::core {

// The value of type To with the bits of `from`.
template <typename To, typename From>
constexpr To bit_cast(const From &from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  return __builtin_bit_cast(To, from);
}

}  // namespace mvs::core
