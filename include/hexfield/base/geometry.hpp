#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hexfield {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
/// Unit quaternion (w, x, y, z). As a frame it is the rotation whose matrix columns are the axes u, v, w.
using Quaternion = Eigen::Quaterniond;

}  // namespace hexfield
