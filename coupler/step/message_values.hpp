/// The coupling's values as the messages want them, and back.
#pragma once

#include <cstdint>

#include "coupling/interface_mesh.hpp"
#include "coupling/rigid_dofs.hpp"
#include "coupling/rigid_motion.hpp"
#include "proto/messages.hpp"

namespace fpi {

inline proto::Vec3 to_wire(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

proto::Motion to_wire(std::uint32_t body, const coupling::RigidMotion& motion);
coupling::RigidMotion from_wire(const proto::Motion& motion);

/// Arcs with the rigid velocity field of `motion` on them.
proto::Interface to_wire(std::uint32_t body, const coupling::Arcs& arcs, const coupling::RigidMotion& motion);
/// What a body feels, for the DEM, where nobody knows on which arcs.
proto::Load to_wire(std::uint32_t body, const coupling::RigidLoad& load);
/// What a body feels, for the DEM: its traction on the arcs and what it adds up to.
proto::Load to_wire(const coupling::Arcs& arcs, const proto::Traction& traction);

}  // namespace fpi
