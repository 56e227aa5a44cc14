// Doubles as decimal text and back, with a shift of the decimal point: metres in memory are
// millimetres in text. The shift changes the exponent, not the digits, so that a round trip is
// exact for any shift, which x * 1000 / 1000 is not. Independent of the locale.
#pragma once

#include <string>
#include <string_view>

namespace mvs::core {

// Appends value * 10^shift in the fewest digits (17 at most) that read back as the same double.
// `value` must be finite.
void append_decimal(std::string &out, double value, int shift = 0);

// Reads `token` and divides by 10^shift, correctly rounded. False if the token is not a decimal
// number ("nan", "0x1", "1,5"), is too long, or the result is too large or too small for a double.
bool parse_decimal(std::string_view token, double &value, int shift = 0);

}  // namespace mvs::core
