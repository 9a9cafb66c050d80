#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// The tagged feature points, curves and surfaces that the hex mesh must keep, by vertex ids of a TetMesh.
/// A colour is the positive integer that the input gave the entity. Ordered maps, so that every walk over
/// features has one order.
struct Features {
  std::map<VertexId, int> points;
  std::map<EdgeKey, int> edges;
  std::map<FaceKey, int> faces;
  /// Colour (material) per tet slot of the mesh; empty when the input has one unnamed volume.
  std::vector<int> tet_colours;
  /// Names of physical groups: (dimension 0..3, colour) -> name.
  std::map<std::pair<int, int>, std::string> names;
};

/// Edges and corners that are sharper are features where the input tags none (spec-lmff section 1).
inline constexpr double default_feature_angle_degrees = 70;

/// Completes the tags of the input to what the stages need, without changing a tag (spec-lmff section 1,
/// feature closure of spec-quantization section 1). What is added gets new colours, in this order:
///  * faces: all boundary faces, and the faces between tets of different colours; one colour per patch;
///  * edges: with a number of incident feature faces that is neither 0 nor 2, or between two feature faces of
///    different colours; where the input tags no edge at all, also those at which two feature faces deviate from
///    a plane by more than `degrees`; one colour per curve;
///  * points: with a number of incident feature edges that is neither 0 nor 2, or between two feature edges of
///    different colours; where the input tags no point at all, also the corners of curves sharper than `degrees`;
///    one colour each.
/// The tags given must be entities of the mesh (see mesh/input_check.hpp). Not collective.
void complete_features(const TetMesh& mesh, Features& features, double degrees = default_feature_angle_degrees);

/// The features of a mesh without tags: complete_features() of none. `tet_colours` are kept and separated.
Features features_from_angles(const TetMesh& mesh, double degrees = default_feature_angle_degrees,
                              std::vector<int> tet_colours = {});

/// Features that are no vertices, edges or faces of the mesh, colours that are not positive, a wrong number of
/// tet colours, and what complete_features() would still add (but for its angles).
std::vector<Violation> check(const TetMesh& mesh, const Features& features);

}  // namespace hexfield
