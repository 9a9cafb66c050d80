#pragma once

#include <map>
#include <vector>

#include "hexfield/mesh/aabb_tree.hpp"
#include "hexfield/mesh/features.hpp"
#include "hexfield/mesh/tet_mesh.hpp"

namespace hexfield {

/// The point of the triangle (a, b, c) closest to p; degenerate triangles are segments or points.
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
/// The point of the segment (a, b) closest to p.
Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);

struct SurfaceProjection {
  Vec3 point;
  Vec3 normal;  ///< unit normal of `face`: out of the mesh; out of the side of the lower tet colour inside
  FaceKey face;
  double distance;
};

struct CurveProjection {
  Vec3 point;
  Vec3 tangent;  ///< unit, from edge[0] to edge[1]
  EdgeKey edge;
  double distance;
};

/// Closest points on the feature faces of a mesh, colour by colour. Keeps copies: the mesh may go away.
/// Queries may run in parallel. The lowest FaceKey wins ties.
class ClosestSurface {
 public:
  ClosestSurface(const TetMesh& mesh, const Features& features);
  bool has(int colour) const { return patches_.count(colour) != 0; }
  /// Throws Error(bug) when no feature face has that colour.
  SurfaceProjection project(const Vec3& p, int colour) const;

 private:
  struct Triangle {
    std::array<Vec3, 3> corners;  // counter-clockwise seen from where the normal points
    FaceKey face;
  };
  struct Patch {
    std::vector<Triangle> triangles;  // ascending by face
    AabbTree tree;
  };
  std::map<int, Patch> patches_;
};

/// Closest points on the feature edges of a mesh, colour by colour; as ClosestSurface.
class ClosestCurve {
 public:
  ClosestCurve(const TetMesh& mesh, const Features& features);
  bool has(int colour) const { return curves_.count(colour) != 0; }
  /// Throws Error(bug) when no feature edge has that colour.
  CurveProjection project(const Vec3& p, int colour) const;

 private:
  struct Segment {
    std::array<Vec3, 2> ends;
    EdgeKey edge;
  };
  struct Curve {
    std::vector<Segment> segments;  // ascending by edge
    AabbTree tree;
  };
  std::map<int, Curve> curves_;
};

}  // namespace hexfield
