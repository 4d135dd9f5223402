// The settings of every effect, in SI units. The presence of an effect's settings enables it (EffectSettings).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <variant>

namespace bleedsim::sph {

using Vec3 = Eigen::Vector3d;

struct GravitySettings {
  Vec3 acceleration{0.0, 0.0, -9.81};  ///< m/s^2
};

enum class PressureForm { variational, symmetric };  ///< (16), (17)
struct PressureSettings {
  PressureForm form = PressureForm::variational;
  double background_pressure = 0.0;  ///< Pa
};

/// One viscosity for every shear rate: ViscositySettings::viscosity, or a block's own.
struct NewtonianRheology {};
/// mu = mu_inf + (mu_0 - mu_inf) (1 + (lambda g)^a)^((n - 1)/a), g the shear rate; Cho & Kensey 1991.
struct CarreauYasudaRheology {
  double zero_shear = 0.056;        ///< mu_0, Pa s
  double infinite_shear = 0.00345;  ///< mu_inf, Pa s
  double time = 3.313;              ///< lambda, s
  double power = 0.3568;            ///< n
  double transition = 2.0;          ///< a
};
/// sqrt(mu) = sqrt(mu_c) + sqrt(tau_y (1 - exp(-g/g_r))/g): Casson's law, regularised at rest (Papanastasiou 1987).
struct CassonRheology {
  double yield_stress = 0.005;             ///< tau_y, Pa
  double viscosity = 0.0035;               ///< mu_c, Pa s
  double regularisation_shear_rate = 0.1;  ///< g_r, 1/s
};
using Rheology = std::variant<NewtonianRheology, CarreauYasudaRheology, CassonRheology>;

enum class ViscositySolve {
  automatic,  ///< implicit where the explicit limit would be the smallest limit of the time step
  explicit_,  ///< in the pair loop
  implicit    ///< conjugate gradients after the kick
};
struct ViscositySettings {
  double viscosity = 0.00345;  ///< Pa s, of every Newtonian particle that does not bring its own
  Rheology rheology = NewtonianRheology{};
  ViscositySolve solve = ViscositySolve::automatic;
  double solve_tolerance = 1e-2;  ///< of the implicit solve: residual over right-hand side
  int max_iterations = 100;       ///< of the implicit solve in one step
};

/// Curvature form, physics.md section 2.
struct SurfaceTensionSettings {
  double coefficient = 0.0526;          ///< sigma, N/m
  double normal_cutoff = 0.3;           ///< particles with |n| h above it are surface
  std::optional<double> contact_angle;  ///< rad, on tissue; without it the surface meets tissue as it comes
};

/// dP/dt = div(k grad P) - s [r phi(g) P (1 - P) + k_w A_w P + k_a A_a P], mu = b exp(-a P): physics.md section 3.
struct PlateletSettings {
  double fresh = 0.99;              ///< P of blood that comes in
  double diffusivity = 1e-9;        ///< k, m^2/s
  double activation_rate = 0.0153;  ///< r, 1/s: ln 99 over a half time of 300 s
  double wall_rate = 0.01;          ///< k_w, 1/s
  double air_rate = 0.002;          ///< k_a, 1/s
  double shear_gate = 400.0;        ///< shear rate at which blood stays liquid, 1/s
  double clot_viscosity = 10.0;     ///< b, Pa s
  double clot_speedup = 1.0;        ///< s
};

/// (34): h_i follows lambda (m/rho_i)^(1/3), bounded and relaxed. The literal model has bounds of its own.
struct CoreRadiusSettings {
  double smallest = 0.9;    ///< of lambda dx
  double largest = 1.3;     ///< of lambda dx
  double relaxation = 0.1;  ///< part of the way to go in one step
};

/// (35)(36) beside the other forces.
struct RepulsionSettings {
  double strength = 1.5;          ///< D* = D/(m c0^2 dx)
  double contact_distance = 0.9;  ///< 2 r_i/dx, at most 1: beyond it the fluid would expand
  int power_1 = 6, power_2 = 4;   ///< n1 > n2
  double damping = 1.0;           ///< of pairs in contact, in c0/dx
};

/// a = -k_ad f(d) n of the tissue, f = 1 for d < dx, falling linearly to 0 at h.
struct AdhesionSettings {
  double acceleration = 5.0;  ///< k_ad, m/s^2
};

/// What the paper's equations leave open. Read by the literal model only (literal_model.h), in place of the sound effects' own.
struct LiteralSettings {
  PressureForm pressure = PressureForm::symmetric;  ///< (17), the paper's choice, or (16)
  std::optional<double> stiffness;                  ///< k of (18)(19), m^2/s^2; default c0^2; c0 follows it
  double tension = 0.0526;                          ///< eps of (22), N/m
  double normal_cutoff = 0.3;                       ///< tension acts where |n| h is above it
  double thickening = 10.0;                         ///< b of (26), Pa s
  std::optional<double> thickening_exponent;        ///< a of (26); default: fresh blood has ViscositySettings::viscosity
  double platelet_diffusivity = 1e-9;               ///< k of (27), m^2/s
  std::optional<double> repulsion;                  ///< D of (36), N m^2; default 1.5 m c0^2 dx
  int power_1 = 6, power_2 = 4;                     ///< n1 > n2 of (36)
  double contact_radius = 0.45;                     ///< r_i of (35), in spacings
};

struct AppliedForceSettings {
  std::uint32_t max_sources = 64;
};

struct EffectSettings {
  std::optional<GravitySettings> gravity;
  std::optional<PressureSettings> pressure;
  std::optional<ViscositySettings> viscosity;
  std::optional<SurfaceTensionSettings> surface_tension;
  std::optional<PlateletSettings> platelets;
  std::optional<CoreRadiusSettings> core_radius;
  std::optional<RepulsionSettings> repulsion;
  std::optional<AdhesionSettings> adhesion;
  std::optional<AppliedForceSettings> applied_force;
};

}  // namespace bleedsim::sph
