// Writes src/hex/cut_table_rows.cpp anew: make_cut_table > src/hex/cut_table_rows.cpp
#include <fmt/format.h>

#include "hexfield/hex/cut_table.hpp"

int main() {
  fmt::print("// Written by tests/hex/make_cut_table.cpp.\n#include \"cut_table_rows.hpp\"\n\n");
  fmt::print("namespace hexfield::hex {{\n\nconst char* const cut_table_rows = R\"(");
  fmt::print("{}", hexfield::to_text(hexfield::make_cut_table(hexfield::types_of_valence_345())));
  fmt::print(")\";\n\n}}  // namespace hexfield::hex\n");
}
