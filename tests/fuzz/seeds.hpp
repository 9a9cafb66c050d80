#pragma once

#include <string>
#include <vector>

#include "hexfield/io/hex_io.hpp"
#include "io/samples.hpp"

namespace hexfield::fuzz {

/// A valid small file to start from.
struct Seed {
  std::string name;
  std::string data;
  bool hexes = false;
  bool hexex = false;
};

/// One tet mesh and one hex mesh in every format that can be read, a VTK 5.1 file with all kinds of sections and a
/// .hexex file with rationals, walls and features.
inline std::vector<Seed> seeds() {
  std::vector<Seed> all;
  const TetInput tets = samples::tagged_box();
  const HexMesh hexes = samples::tagged_hexes();
  for (const char* ending : {"vtk", "vtu", "msh", "msh2", "mesh"})
    for (const bool binary : {false, true}) {
      if (binary && std::string(ending) == "mesh") continue;
      const std::string name = std::string(binary ? "binary." : "ascii.") + ending;
      const auto file = samples::scratch_file(name);
      write_tet_mesh(file, tets.mesh, tets.features, {std::nullopt, binary});
      all.push_back({name, hexfield::testing::bytes_of(file)});
      write_hex_mesh(file, hexes, {std::nullopt, binary});
      all.push_back({name, hexfield::testing::bytes_of(file), true});
    }
  all.push_back(
      {"v51.vtk",
       "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET UNSTRUCTURED_GRID\n"
       "FIELD FieldData 2\nTIME 1 1 double\n0.5\nMETADATA\nINFORMATION 0\n\nnote 1 1 string\nhello\n"
       "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nMETADATA\nINFORMATION 0\n\nCELLS 4 9\n"
       "OFFSETS vtktypeint64\n0 4 7 9\nCONNECTIVITY vtktypeint64\n0 1 2 3\n0 1 2\n0 1\nCELL_TYPES 3\n10\n5\n3\n"
       "\nPOINT_DATA 4\nSCALARS t float\nLOOKUP_TABLE default\n1 2 3 4\nCELL_DATA 3\nNORMALS n float\n"
       "0 0 1 0 0 1 0 0 1\nSCALARS quality double 1\nLOOKUP_TABLE mine\n.5 .5 .5\nLOOKUP_TABLE mine 2\n"
       "0 0 0 1 1 1 1 1\nCOLOR_SCALARS c 2\n0 0 1 1 .5 .5\nFIELD FieldData 2\nother 1 3 int\n7 7 7\n"
       "feature 1 3 vtktypeint64\n2 5 0\n"});
  all.push_back({"maps.hexex",
                 "5\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 -1\n2\n0 1 2 3 0 0 0 1 0 0 0 1 0 0 0 1/3\n"
                 "0 2 1 4 5/1 0 0 5 0 -1 5 1 0 123456789012345678901234567890/70000000000000000000000000 0 0\n"
                 "1\n0 1 2 1/2\n1 2 1\n3\n0 1\n0 2\n0 1 2\n",
                 false, true});
  return all;
}

}  // namespace hexfield::fuzz
