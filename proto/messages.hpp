/// The messages between the coupler and its participants, as plain values. `fpi.fbs` is their form on the
/// wire, `codec.hpp` maps one to the other and is the only judge of bytes from outside. conventions: SI
/// units, plane scenes have z = 0 and spin and torque about z; a plane force is that of the scene's whole
/// thickness.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/findings.hpp"

namespace fpi::proto {

inline constexpr std::uint32_t protocol_version = 4;

using Vec3 = std::array<double, 3>;
using Bytes = std::vector<std::uint8_t>;
/// Named numbers: counters, timers [s], peak memory [B].
using Figures = std::vector<std::pair<std::string, double>>;

/// Which step and which sub-iteration a message belongs to; step 0 is everything before the first step.
struct Stamp {
  std::uint64_t run = 0;
  std::uint64_t step = 0;
  std::uint32_t sub_iteration = 0;
  bool operator==(const Stamp&) const = default;
};

// ---- joining ------------------------------------------------------------------------------------

/// First message of a participant.
struct Hello {
  std::uint32_t protocol_version = proto::protocol_version;
  std::string role{};  ///< "fluid" | "dem"
  std::string program{}, program_version{};
  std::vector<std::string> capabilities{};  ///< of the participant, see fpi.fbs
  std::uint64_t schema_fingerprint = 0;     ///< of fpi.fbs
  std::uint64_t scene_fingerprint = 0;      ///< 0: any scene
};
struct Welcome {
  std::uint64_t scene_fingerprint = 0;
  double heartbeat_interval = 0.5;  ///< [s] that the participant keeps to
  double silence_timeout = 30;      ///< [s] without a sign of life after which either side gives the other up
};
struct Refusal {
  std::string reason{};
};
/// A file that the scene names: a mesh, a table of grains.
struct File {
  std::string name{};  ///< as in the scene
  Bytes bytes{};
};
/// The participant's part of the scene.
struct Configure {
  std::string scene{};        ///< TOML, all defaults filled in
  std::vector<File> files{};  ///< all that it names
  Bytes state{};              ///< of State, when a run is resumed; else empty
};
/// The length of arc or edge [m] that the fluid wants for the interface mesh of a body at its place now.
struct ArcLength {
  std::uint32_t body = 0;
  double length = 0;
};
struct Configured {
  std::vector<ArcLength> arc_lengths{};  ///< fluid: one for every body
  double resolved_gap_ratio = 0;         ///< fluid: gaps below this part of a body's arc length it does not
                                         ///< resolve; 0: not said
  std::vector<std::string> notes{};      ///< what is skipped, and why; for the log
  Figures figures{};                     ///< e.g. unknowns
  std::vector<Finding> findings{};       ///< without their places; after an error nothing else is asked
};

// ---- a step -------------------------------------------------------------------------------------

/// Rigid state of a body.
struct Motion {
  std::uint32_t body = 0;                         ///< index in the scene's [[bodies]]
  Vec3 position{};                                ///< centre [m]
  std::array<double, 4> orientation{1, 0, 0, 0};  ///< unit quaternion (w, x, y, z)
  Vec3 velocity{};                                ///< [m/s]
  Vec3 spin{};                                    ///< [rad/s]
};

/// The balance of momentum of a free body over the step: mass (V − velocity)/Δt is `force` and the force of
/// the fluid; likewise its spin.
struct Balance {
  double mass = 0, inertia = 0;  ///< [kg], [kg m²]
  Vec3 velocity{}, spin{};       ///< at the start of the step [m/s], [rad/s]
  Vec3 force{}, torque{};        ///< mean over the step of all but the fluid [N], [N m]
  bool operator==(const Balance&) const = default;
};

/// The interface mesh of one body, with its velocities. Arc a runs counter-clockwise from angle start[a] to
/// end[a] [rad] on the circle; an edge runs from vertex a to vertex a + 1 (closed surface, body on the left).
struct Interface {
  std::uint32_t body = 0;
  Vec3 centre{};                       ///< [m]; point that the torque is taken about
  double radius = 0;                   ///< [m] of the arcs; 0: edges
  std::vector<double> start{}, end{};  ///< [rad]
  std::vector<double> vertices{};      ///< [m] x, y of each, of a surface of edges
  bool rigid = true;                   ///< velocity law u = translation + spin × (x − centre)
  Vec3 translation{}, spin{};          ///< [m/s], [rad/s]
  std::uint32_t points = 0;            ///< Gauss–Legendre points an arc or edge
  std::vector<double> velocities{};    ///< [m/s] x, y at these points, arc after arc
  std::optional<Balance> balance{};  ///< to a fluid that can: it finds the velocity, those above are a guess
  std::size_t size() const { return radius > 0 ? start.size() : vertices.size() / 2; }
  bool operator==(const Interface&) const = default;
};
struct FluidAdvance {
  double time = 0;       ///< [s] at the end of the step
  double time_step = 0;  ///< [s]; 0 asks for the steady state
  std::vector<Interface> interfaces{};
  bool same_interfaces = false;   ///< they are those of the last accepted step, and none are sent
  bool wants_resistance = false;  ///< of the bodies with a balance; in the first sub-iteration of a step
  bool rehearsal = false;         ///< nothing is solved: only what would refuse the step is wanted
};
/// λ on the arcs or edges of a body, and what it adds up to.
struct Traction {
  std::uint32_t body = 0;
  std::vector<double> values{};  ///< λ [Pa], x, y of each arc
  Vec3 force{};                  ///< [N] on the body, with the buoyancy
  Vec3 torque{};                 ///< [N m] about the centre
  double arc_length = 0;         ///< [m] wanted next; 0: the body meets no element
  Vec3 velocity{}, spin{};       ///< [m/s], [rad/s] that the fluid found, where it was sent a balance
  /// Impulse of the fluid on the body in the step over its length [N], [N m]: what moves a free body. Where
  /// it is not given, force and torque are taken for it.
  std::optional<Vec3> mean_force{}, mean_torque{};
};
struct FluidAdvanced {
  bool converged = false;
  std::string reason{};  ///< why not
  std::vector<Traction> tractions{};
  std::uint32_t newton_iterations = 0;
  double residual = 0;          ///< last relative Newton update
  double time_error = 0;        ///< estimated for this step, relative to the velocity
  double time_error_order = 0;  ///< power of the time step that it goes with; 0: no error is said
  /// By rows, how force x, y and torque go with velocity x, y and spin at the end of the step, of all bodies
  /// with a balance, mass/Δt included [kg/s, kg m/s, kg m²/s]; empty: not wanted, or not known.
  std::vector<double> resistance{};
  double speed = 0;                 ///< [m/s] root mean square of the fluid's velocity; 0: not said
  std::vector<Finding> findings{};  ///< of a rehearsal
};

/// What a body feels besides gravity and contact.
struct Load {
  std::uint32_t body = 0;
  Vec3 force{};                        ///< [N]
  Vec3 torque{};                       ///< [N m]
  std::vector<double> start{}, end{};  ///< arcs [rad], as in Interface
  std::vector<double> tractions{};     ///< λ [Pa], x, y of each arc
  Vec3 velocity{}, spin{};             ///< at the end of the step, with which the fluid exerts this
  double added_mass = 0;     ///< [kg] with another velocity V it exerts −added_mass (V − velocity)/Δt
                             ///< more
  double added_inertia = 0;  ///< [kg m²] likewise of the torque
};
struct DemAdvance {
  double time = 0;                   ///< [s] at the end of the step
  double time_step = 0;              ///< [s]
  std::vector<Load> loads{};         ///< held over the step
  std::vector<Motion> prescribed{};  ///< at the end of the step, for every body that is not free
  std::vector<double>
      resolved_gaps{};  ///< [m] of every body: narrower gaps the fluid does not resolve; empty: no fluid
  std::vector<Motion> walls{};  ///< at the end of the step, for every wall that moves; `body` is its index
  std::vector<double> resistance{};  ///< of the bodies of `loads`, as the fluid said it; empty: not known
};
struct DemAdvanced {
  bool converged = false;
  std::string reason{};
  std::vector<Motion> motions{};  ///< of every body, at the end of the step
  std::uint64_t sub_steps = 0;
  std::vector<std::uint32_t> contacts{};  ///< of every body, at the end of the step; empty: not said
  double largest_overlap = 0;             ///< [m] met during the step
};

struct Accept {
  std::vector<std::uint32_t> left{};  ///< bodies that leave the run where the step ends
};
/// Figures of the accepted state: for the fluid the scene's probes by name, and the force on each named
/// boundary as "force_x:NAME", "force_y:NAME" [N].
struct Accepted {
  Figures figures{};
  std::vector<Finding> findings{};  ///< each once in a run
};
struct Restore {};
struct Restored {};

// ---- results and state --------------------------------------------------------------------------

struct Write {
  bool mesh = false;  ///< points and cells are wanted too
};
/// One field: components of each point or cell, one after another.
struct Field {
  std::string name{};
  bool on_cells = false;
  std::uint32_t components = 1;
  std::vector<double> values{};
};
/// Values along a named curve. Its lines are quadratic, or straight from point to point where none are given.
struct Curve {
  std::string name{};
  std::vector<double> points{};        ///< [m] x, y, z of each
  std::vector<std::uint32_t> lines{};  ///< 3 points each: both ends, then the middle
  std::uint32_t components = 1;
  std::vector<double> values{};  ///< components of each point, one after another
};
/// Numbers by column, row after row.
struct Sheet {
  std::string name{};  ///< of the file NAME.csv that the coupler writes
  std::vector<std::string> columns{};
  std::vector<double> values{};
};
/// Points x, y, z and quadratic triangles (three corners, then the middles of sides 01, 12, 20).
struct Fields {
  double time = 0;
  std::vector<double> points{};
  std::vector<std::uint32_t> cells{};  ///< 6 each
  std::vector<Field> fields{};
  std::vector<Curve> boundaries{};  ///< traction [Pa] of the fluid, x, y, at the nodes of fitted boundaries
  std::vector<Curve> profiles{};    ///< the quantity of each [[profiles]]
  std::vector<Sheet> tables{};      ///< what [percolation] asks for
};
struct Checkpoint {};
struct State {
  Bytes bytes{};  ///< only its participant reads them
};

// ---- life ---------------------------------------------------------------------------------------

/// Sent from a thread of its own, so that "busy" and "dead" differ.
struct Heartbeat {
  std::string phase{};  ///< e.g. "factor"
  double progress = 0;  ///< 0 to 1 within the phase, where known
};
struct Failure {
  std::string who{}, phase{}, text{};  ///< the step is in the stamp
};
struct Goodbye {
  std::string reason{};
};
/// Last message of a participant: its counters, timers and peak memory.
struct Farewell {
  Figures figures{};
};

using Message = std::variant<Hello, Welcome, Refusal, Configure, Configured, FluidAdvance, FluidAdvanced,
                             DemAdvance, DemAdvanced, Accept, Accepted, Restore, Restored, Write, Fields,
                             Checkpoint, State, Heartbeat, Failure, Goodbye, Farewell>;

struct Envelope {
  Stamp stamp;
  Message message;
};

}  // namespace fpi::proto
