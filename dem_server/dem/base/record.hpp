/// Four numbers of a body side by side, so that one load takes a vector and what is read with it.
#pragma once

#include "dem/base/rotation.hpp"

namespace fpi::dem {

using Record = Eigen::Vector4d;

inline Record join(const Vec3& v, double fourth) { return {v.x(), v.y(), v.z(), fourth}; }

}  // namespace fpi::dem
