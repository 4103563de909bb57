/// [dem] and [[materials]]: the grains' contacts.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/fluid.hpp"

namespace fpi::scene {

/// [[materials]]
struct Material {
  std::string name;
  double youngs_modulus = 0;     ///< E [Pa], of the Hertz contact
  double normal_stiffness = 0;   ///< k_n [N/m], of the linear contact
  double poisson_ratio = 0.25;   ///< ν
  double restitution = 0.9;      ///< e, ratio of normal speeds after and before an impact
  double friction = 0.3;         ///< Coulomb μ
  double rolling_friction = 0;   ///< μ_r: rolling moment ≤ μ_r R* N
  double adhesion = 0;           ///< w [J/m²]
  double twisting_friction = 0;  ///< μ_t: twisting moment ≤ μ_t R* N

  void declare(ParameterVisitor& v) {
    v.text({"name", "", "name that bodies and walls refer to; unique", true}, name);
    v.real({"youngs_modulus", "Pa",
            "E, needed where dem.contact = \"hertz\"; discs touch as spheres of their radius, whatever the "
            "thickness"},
           youngs_modulus, not_negative());
    v.real({"normal_stiffness", "N/m",
            "k_n of a contact between two of this material, needed where dem.contact = \"linear\"; two "
            "materials have the harmonic mean of theirs"},
           normal_stiffness, not_negative());
    v.real({"poisson_ratio", "", "Poisson's ratio"}, poisson_ratio, between(0, 0.5));
    v.real({"restitution", "", "normal speed after over before a dry impact"}, restitution,
           above_up_to(0, 1));
    v.real({"friction", "", "Coulomb friction coefficient μ"}, friction, not_negative());
    v.real({"rolling_friction", "", "rolling resistance coefficient: moment at most μ_r R* N"},
           rolling_friction, not_negative());
    v.real({"adhesion", "J/m²", "work of adhesion w: surfaces that touch pull with 3/2 π w R*; 0: none"},
           adhesion, not_negative());
    v.real(
        {"twisting_friction", "", "resistance to spin about the contact's normal: moment at most μ_t R* N"},
        twisting_friction, not_negative());
  }
};

/// [dem.lubrication]: liquid films in gaps narrower than the fluid's mesh resolves.
struct Lubrication {
  std::optional<double> viscosity;  ///< μ [Pa s]; none: that of [fluid], and no films where there is none
  double roughness = 1e-3;          ///< of the smaller radius

  void declare(ParameterVisitor& v) {
    v.real({"viscosity", "Pa s",
            "viscosity of the liquid between the grains; 0: no films; else the fluid's, and no films without "
            "one"},
           viscosity, not_negative());
    v.real({"roughness", "", "gap below which a film resists no more, over the smaller radius"}, roughness,
           above_up_to(0, 1));
  }
};

/// [dem.near_field]: f = κ₁ d^(−a₁) − κ₂ d^(−a₂) between bodies whose centres are d < cut_off apart.
struct NearField {
  double attraction = 0, attraction_exponent = 1;  ///< κ₁ [N m^a₁], a₁
  double repulsion = 0, repulsion_exponent = 2;    ///< κ₂ [N m^a₂], a₂
  double cut_off = 0;                              ///< [m]
  bool acts() const { return cut_off > 0; }

  void declare(ParameterVisitor& v) {
    v.real({"attraction", "N m^a",
            "κ₁: bodies attract each other with κ₁ d^(−a₁), d the distance of their centres"},
           attraction, not_negative());
    v.real({"attraction_exponent", "", "a₁"}, attraction_exponent, between(0, 20));
    v.real({"repulsion", "N m^a", "κ₂: bodies repel each other with κ₂ d^(−a₂)"}, repulsion, not_negative());
    v.real({"repulsion_exponent", "", "a₂"}, repulsion_exponent, between(0, 20));
    v.real({"cut_off", "m", "distance of the centres from which on both are zero; 0: there is no near field"},
           cut_off, not_negative());
  }
};

/// [dem]
struct Dem {
  Launch launch;
  std::string contact = "hertz";  ///< hertz | linear
  double steps_per_contact = 50;  ///< t_c over the sub-step while something touches
  double largest_sub_step = 0;    ///< [s]; 0: the coupling step
  double start_overlap = 0.01;    ///< of the smaller radius
  std::string scheme = "verlet";  ///< verlet | trapezoidal
  std::string loads = "held";     ///< held | linear
  bool energy = false;            ///< whether the account of energies is kept
  double stretch = 1;             ///< of contact times
  double lost_distance = 0;       ///< [m]; 0: as far as makes sense of the scene
  Lubrication lubrication;
  NearField near_field;
  double adhesion_range = 0.01;  ///< over R*

  static constexpr std::array<std::string_view, 2> contacts{"hertz", "linear"};
  /// Entries of the account: had, lost to each cause, supplied by each, and the error of the steps.
  static constexpr std::array<std::string_view, 11> energies{"kinetic",  "potential", "elastic",  "damping",
                                                             "friction", "turning",   "films",    "left",
                                                             "loads",    "walls",     "numerical"};
  static constexpr std::array<std::string_view, 2> schemes{"verlet", "trapezoidal"};
  static constexpr std::array<std::string_view, 2> loads_in_time{"held", "linear"};

  void declare(ParameterVisitor& v) {
    launch.declare(v);
    v.choice(
        {"contact", "", "normal force: Hertz's by youngs_modulus, or a linear spring by normal_stiffness"},
        contact, contacts);
    v.real({"steps_per_contact", "", "sub-steps in the contact time of the stiffest pair that can touch"},
           steps_per_contact, between(10, 1e6));
    v.real(
        {"largest_sub_step", "s",
         "upper limit of the sub-step; contacts shorten it by themselves where they need to; 0: the coupling "
         "step"},
        largest_sub_step, not_negative());
    v.choice({"scheme", "",
              "sub-steps by velocity Verlet, or by the implicit trapezoidal rule, which is for comparison in "
              "small "
              "scenes: it costs several times as much; among films of liquid Verlet always"},
             scheme, schemes);
    v.choice({"loads", "",
              "force of the fluid over a step: held at that of its end, or linear from that of the step "
              "before; linear "
              "is of second order in the step and may take more sub-iterations"},
             loads, loads_in_time);
    v.boolean(
        {"energy", "",
         "keep an account of energies: columns energy.kinetic, … of history.csv [J], see docs/grains.md"},
        energy);
    v.real({"stretch", "",
            "contacts last this many times as long, by softer surfaces of the same restitution, so that "
            "sub-steps "
            "may be as much longer; impacts overlap that many times as far: the run warns of it; 1: as the "
            "materials "
            "say"},
           stretch, between(1, 1000));
    v.real({"start_overlap", "",
            "how far a free body may overlap another or a wall at the start, of the smaller radius"},
           start_overlap, between(0, 0.5));
    v.real({"lost_distance", "m",
            "a free body farther than this outside the box around all bodies and walls at the start is lost, "
            "and the run ends; 0: a thousand diagonals of that box, or as far as bodies fly and fall in the "
            "run"},
           lost_distance, not_negative());
    v.real({"adhesion_range", "", "gap, over R*, on which the pull of adhesion falls to zero"},
           adhesion_range, above_up_to(0, 1));
    v.table({"near_field", "", "attraction and repulsion between bodies that need not touch"}, near_field);
    v.table({"lubrication", "", "what narrow gaps resist with beyond what the fluid's mesh resolves"},
            lubrication);
  }
};

/// Column of history.csv, and name of the figure of a participant, of an entry of Dem::energies.
inline std::string energy_column(std::size_t entry) { return "energy." + std::string(Dem::energies[entry]); }

}  // namespace fpi::scene
