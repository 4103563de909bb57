/// How well mesh and step resolve the flow of a run: figures before it and of it, and a word, once, where
/// they are beyond what measurements support (docs/numerics.md).
#pragma once

#include <set>
#include <string>
#include <vector>

#include "fluid/navier_stokes.hpp"
#include "proto/messages.hpp"
#include "scene/scene.hpp"

namespace fpi::fluid {

class ResolutionReport {
 public:
  /// From what the scene gives: initial velocity, velocities at boundaries and of bodies.
  void begin(const scene::Scene& scene, const NavierStokes& solver, Findings& findings);
  /// With every accepted step: what is found for the first time.
  std::vector<Finding> accept(const NavierStokes& solver);
  /// "resolution:NAME" of expected_unknowns, expected_memory_bytes; of the largest so far, what is given
  /// included: speed [m/s], reynolds of the largest body, or else of the channel, cell_reynolds, courant; and
  /// viscous_number νΔt/h² of the smallest element.
  proto::Figures figures() const;

 private:
  void judge(const Resolution& now, const std::string& when, Findings& findings);
  void warn_once(const std::string& key, const std::string& text, Findings& findings);

  bool convection_ = true;
  double viscosity_ = 1;   ///< ν [m²/s]
  double length_ = 0;      ///< [m] of the Reynolds number
  std::string length_of_;  ///< what it is the diameter or width of
  double smallest_ = 0;    ///< element [m]
  double time_step_ = 0;   ///< [s] largest
  double unknowns_ = 0;
  Resolution largest_;
  std::set<std::string> told_;
};

}  // namespace fpi::fluid
