#include "hexfield/hex/cut_table.hpp"

#include <fmt/format.h>

#include <sstream>

#include "cut_table_rows.hpp"

namespace hexfield {
namespace {

std::vector<std::vector<int>> cycles_of_letters(const std::string& text) {
  std::vector<std::vector<int>> out;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    out.emplace_back();
    for (char c : word) out.back().push_back(c - 'a');
  }
  return out;
}

CutTable parse(const char* text) {
  CutTable table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    std::istringstream fields(line);
    std::string code;
    std::string number;
    std::string cycles;
    CutRow row;
    std::getline(fields, code, '|');
    std::getline(fields, number, '|');
    row.splits_to_5 = std::stoi(number);
    std::getline(fields, number, '|');
    row.splits_to_6 = std::stoi(number);
    std::getline(fields, cycles, '|');
    row.cycles = cycles_of_letters(cycles);
    table.emplace(std::move(code), std::move(row));
  }
  return table;
}

}  // namespace

std::string to_text(const CutTable& table) {
  std::string text;
  for (const auto& [code, row] : table) {
    text += fmt::format("{}|{}|{}|", code, row.splits_to_5, row.splits_to_6);
    for (std::size_t k = 0; k < row.cycles.size(); ++k) {
      if (k > 0) text.push_back(' ');
      for (int v : row.cycles[k]) text.push_back(static_cast<char>('a' + v));
    }
    text.push_back('\n');
  }
  return text;
}

const CutTable& cut_table() {
  static const CutTable table = parse(hex::cut_table_rows);
  return table;
}

}  // namespace hexfield
