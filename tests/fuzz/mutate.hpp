#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace hexfield::fuzz {

/// Changes of a file that a broken disk, an unfinished copy or a careless editor make; the same for a seed everywhere.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

  /// `other` gives the blocks that are spliced in.
  std::string mutated(std::string data, const std::string& other) {
    for (std::size_t times = 1 + below(3); times > 0; --times) mutate(data, other);
    return data;
  }

 private:
  void mutate(std::string& data, const std::string& other) {
    switch (below(9)) {
      case 0:  // bit flip
        if (!data.empty()) data[below(data.size())] ^= static_cast<char>(1U << below(8));
        break;
      case 1:  // truncation, or a number in place of another where half the cuts would be
        if (below(3) == 0)
          data.resize(below(data.size() + 1));
        else
          replace_number(data, std::to_string(below(16)));
        break;
      case 2:  // another number in place of one
        replace_number(data, odd_number());
        break;
      case 3:  // two numbers change places
        swap_numbers(data);
        break;
      case 4:  // a line twice
        duplicate_line(data);
        break;
      case 5:  // a line less
        erase_line(data);
        break;
      case 6:  // a block of another file
        splice(data, other);
        break;
      case 7:  // a block gone
        data.erase(below(data.size() + 1), below(64));
        break;
      default:  // a binary word overwritten
        overwrite_word(data);
    }
  }

  std::string odd_number() {
    static constexpr std::array<std::string_view, 20> odd = {
        "-1",  "0",    "1",     "2",      "3",    "4",   "7",    "1e300", "-1e-300",    "nan",
        "inf", "1e99", "65536", "1e9999", "-1e9", "1/0", "12/5", "\"",    "2147483648", "99999999999999999999"};
    return std::string(odd[below(odd.size())]);
  }

  static bool digit(char c) { return c >= '0' && c <= '9'; }

  /// A token of digits, signs and points near a random place: [begin, end).
  std::pair<std::size_t, std::size_t> some_number(const std::string& data) {
    std::size_t at = below(data.size() + 1);
    while (at < data.size() && !digit(data[at])) ++at;
    const auto part = [&](char c) { return digit(c) || c == '.' || c == '-' || c == 'e' || c == '/'; };
    std::size_t begin = at, end = at;
    while (begin > 0 && part(data[begin - 1])) --begin;
    while (end < data.size() && part(data[end])) ++end;
    return {begin, end};
  }

  void replace_number(std::string& data, const std::string& by) {
    const auto [begin, end] = some_number(data);
    data.replace(begin, end - begin, by);
  }

  void swap_numbers(std::string& data) {
    const auto [a, b] = some_number(data);
    const auto [c, d] = some_number(data);
    const std::string first = data.substr(a, b - a);
    const std::string second = data.substr(c, d - c);
    data.replace(std::max(a, c), a > c ? b - a : d - c, a > c ? second : first);
    data.replace(std::min(a, c), a > c ? d - c : b - a, a > c ? first : second);
  }

  std::pair<std::size_t, std::size_t> some_line(const std::string& data) {
    const std::size_t at = below(data.size() + 1);
    const std::size_t before = at == 0 ? std::string::npos : data.rfind('\n', at - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::size_t after = data.find('\n', at);
    return {begin, after == std::string::npos ? data.size() : after + 1};
  }

  void duplicate_line(std::string& data) {
    const auto [begin, end] = some_line(data);
    const std::string line = data.substr(begin, end - begin);
    data.insert(below(2) == 0 ? end : some_line(data).first, line);
  }

  void erase_line(std::string& data) {
    const auto [begin, end] = some_line(data);
    data.erase(begin, end - begin);
  }

  void splice(std::string& data, const std::string& other) {
    const std::size_t from = below(other.size() + 1);
    const std::string block = other.substr(from, below(200));
    const std::size_t at = below(data.size() + 1);
    data.replace(at, below(2) == 0 ? std::min(block.size(), data.size() - at) : 0, block);
  }

  void overwrite_word(std::string& data) {
    static constexpr std::array<std::uint64_t, 8> words = {0,          1,          ~std::uint64_t{0},  0x7fffffff,
                                                           0x80000000, 0x01000000, 0x7ff8000000000000, 5};
    const std::uint64_t word = words[below(words.size())];
    const std::size_t at = below(data.size() + 1);
    for (std::size_t k = 0; k < 8 && at + k < data.size(); ++k) data[at + k] = static_cast<char>(word >> (8 * k));
  }

  std::mt19937_64 random_;
};

}  // namespace hexfield::fuzz
