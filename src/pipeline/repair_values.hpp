#pragma once

#include "hexfield/io/named_arrays.hpp"
#include "hexfield/repair/repair_field.hpp"

/// The values of stage 3 as arrays of a checkpoint group, and back, bit for bit: see io/checkpoint_values.hpp.
namespace hexfield {

/// Refers to the memory of `field`, which must live on while the arrays are used.
NamedArrays pack_repair(const FieldResult& field, const RepairReport& report);
NamedArrays pack(const RepairIterate& iterate);
RepairResult unpack_repair(const NamedArrays& arrays);
RepairIterate unpack_repair_iterate(const NamedArrays& arrays);

}  // namespace hexfield
