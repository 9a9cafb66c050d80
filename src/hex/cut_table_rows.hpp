#pragma once

namespace hexfield::hex {

/// Rows of cut_table() as text, written by tests/hex/make_cut_table.cpp.
extern const char* const cut_table_rows;

}  // namespace hexfield::hex
