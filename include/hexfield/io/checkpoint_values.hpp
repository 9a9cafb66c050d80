#pragma once

#include "hexfield/field/compute_field.hpp"
#include "hexfield/hex/hex_mesh.hpp"
#include "hexfield/io/named_arrays.hpp"
#include "hexfield/io/tet_io.hpp"
#include "hexfield/map/compute_map.hpp"

/// The value types as arrays of a checkpoint group, and back. What comes back equals what went in, bit for bit.
/// pack_* may refer to the memory of the value, which must live on while the arrays are used; unpack_* throw
/// Error(bad_input) when an array is missing, has another shape, or holds ids out of range.
namespace hexfield {

NamedArrays pack(const TetInput& input);
NamedArrays pack(const FieldResult& result);
NamedArrays pack(const SeamlessResult& result);
NamedArrays pack(const IgmResult& result);
NamedArrays pack(const HexMesh& mesh);

TetInput unpack_tet_input(const NamedArrays& arrays);
FieldResult unpack_field(const NamedArrays& arrays);
/// The map must belong to a mesh of `num_tets` tets.
SeamlessResult unpack_seamless(const NamedArrays& arrays, std::size_t num_tets);
IgmResult unpack_igm(const NamedArrays& arrays, std::size_t num_tets);
HexMesh unpack_hex_mesh(const NamedArrays& arrays);

}  // namespace hexfield
