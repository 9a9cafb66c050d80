#include "rational.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

namespace hexfield::io {
namespace {

using Integer = boost::multiprecision::cpp_int;

bool is_integer(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

Integer integer(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t first = std::min(text.find_first_not_of('0'), text.size() - 1);  // a leading 0 would mean octal
  const Integer value{std::string(text.substr(first))};
  return negative ? Integer(-value) : value;
}

// Quotient of at least 66 bits and one sticky bit for the remainder, rounded once by the conversion.
double nearest_quotient(Integer num, Integer den) {
  if (num == 0) return 0;
  const bool negative = (num < 0) != (den < 0);
  num = abs(num);
  den = abs(den);
  const int shift = 66 + static_cast<int>(msb(den)) - static_cast<int>(msb(num));
  if (shift > 0)
    num <<= static_cast<unsigned>(shift);
  else
    den <<= static_cast<unsigned>(-shift);
  Integer quotient, remainder;
  divide_qr(num, den, quotient, remainder);
  // 65 to 67 bits: keep the upper ones as 64-bit integer with a sticky last bit; its conversion rounds to nearest.
  const int drop = static_cast<int>(msb(quotient)) - 63;
  const Integer kept = quotient >> static_cast<unsigned>(drop);
  const bool sticky = remainder != 0 || (kept << static_cast<unsigned>(drop)) != quotient;
  const auto bits = kept.convert_to<std::uint64_t>() | (sticky ? 1U : 0U);
  const double value = std::ldexp(static_cast<double>(bits), drop - shift);
  return negative ? -value : value;
}

}  // namespace

double read_rational(Scanner& in, const char* what) {
  const std::size_t slash = in.peek().find('/');
  if (slash == std::string_view::npos) return in.real(what);
  const std::string_view token = in.token(what);
  constexpr std::size_t longest = 4096;
  if (token.size() > longest) in.fail(fmt::format("a fraction of {} characters is too long", token.size()));
  const std::string_view num = token.substr(0, slash);
  const std::string_view den = token.substr(slash + 1);
  if (!is_integer(num) || !is_integer(den)) in.fail(fmt::format("\"{}\" is no fraction of integers", printable(token)));
  const Integer divisor = integer(den);
  if (divisor == 0) in.fail(fmt::format("\"{}\" has a zero below the line", printable(token)));
  return nearest_quotient(integer(num), divisor);
}

}  // namespace hexfield::io
