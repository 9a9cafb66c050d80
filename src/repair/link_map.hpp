#pragma once

#include <array>
#include <vector>

#include "hexfield/base/octahedral.hpp"
#include "hexfield/repair/meshability.hpp"

/// The link of a vertex v as a triangulated surface, and drawings of it on spheres glued from octants.
namespace hexfield {

/// Corner k of triangle t is vertex `vertex[k]`, whose image y has there the coordinates matrix(to_tet[k]) y.
struct LinkTriangle {
  TetId tet;
  Quaternion frame = Quaternion::Identity();
  std::array<int, 3> vertex{};
  std::array<octahedral::Rotation, 3> to_tet{};
  std::array<int, 3> across{-1, -1, -1};             ///< triangle at the side from corner k to k + 1; -1 outside
  std::array<octahedral::Rotation, 3> from_chart{};  ///< takes coordinates of this chart to those of across[k]
  /// Label of the normal of the feature face through side k, else no_label; it points out of the tet.
  std::array<octahedral::Label, 3> normal{octahedral::no_label, octahedral::no_label, octahedral::no_label};
};

struct LinkVertex {
  Vec3 direction;                              ///< from v, unit, in world axes
  Vec3 start = Vec3::Zero();                   ///< first guess of the image, in the chart that the corners refer to
  std::array<bool, 3> free{true, true, true};  ///< coordinates of the image that need not be 0
  int free_count() const { return free[0] + free[1] + free[2]; }
};

/// The image angles at these corners (3 triangle + corner) of one vertex sum up to `quads` quarter-turns.
struct LinkSector {
  std::vector<int> corners;
  int quads = 4;
};

struct Link {
  std::vector<LinkVertex> vertices;
  std::vector<LinkTriangle> triangles;
  std::vector<LinkSector> sectors;

  /// Area on the unit sphere by Gauss and Bonnet, in octants.
  int octants() const;
};

/// First guesses from the frames: what they see of the directions of the link vertices, without the coordinates that
/// are not free. Images with one free coordinate that have a guess already keep it.
void guess_images(Link& link);
/// Takes as start of every link vertex that is on no special edge the mean of its neighbours, across the charts: a
/// guess that knows nothing but the codes, for frames that turn faster than the one-ring is fine. False when no special
/// edge holds the images; then nothing has changed.
bool place_harmonically(Link& link);
/// Turns the frames with Algorithm 1 on this link alone: towards each other by the matchings, aligned to feature
/// faces and to vertices with one free coordinate as their images are guessed.
void align_frames(Link& link, int sweeps);

/// The same link with every side split at its midpoint.
Link refined(const Link& link);

/// Image of corner k of triangle t.
Vec3 image_of(const Link& link, std::size_t t, std::size_t k, const std::vector<Vec3>& images);
/// The guesses as images.
std::vector<Vec3> starts(const Link& link);
/// All triangles positive and all sectors as wide as they must be.
bool is_drawing(const Link& link, const std::vector<Vec3>& images, double smallest_det);
/// Necessary conditions: positive area; a sphere with one cone point, or with two of different angles, does not exist
/// unless the angles are whole turns (Troyanov 1989).
bool admits_area(const Link& link);
/// The triangulation may be what forbids a drawing: a side that is no feature joins two vertices that are not free, or
/// so few triangles share a sector that one of them would need an angle of half a turn.
bool is_cramped(const Link& link);
/// Hash of all that decides whether a drawing exists: everything but tets, frames, directions and guesses.
VerdictMemory::Key structure_hash(const Link& link);
/// Images (per link vertex) of a drawing, found from several guesses of one link; empty when none was found.
std::vector<Vec3> find_drawing(const std::vector<Link>& guesses, const VertexMapOptions& options);

}  // namespace hexfield
