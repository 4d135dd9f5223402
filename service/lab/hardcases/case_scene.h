// Small scenes for the hard cases: spacing 1 mm, h = 2 dx, blood, c0 = 5 m/s unless a case says otherwise.
#pragma once

#include "service/lab/dice.h"
#include "service/lab/frame_vectors.h"
#include "service/lab/hardcases/case_run.h"
#include "service/lab/scene_parts.h"
#include "service/sph/world_description.h"

namespace bleedsim::lab {

inline constexpr double kCaseSpacing = 0.001;  ///< m
inline constexpr double kCaseGravity = 9.81;   ///< m/s^2

/// No particle, tissue nor effect; domain +-50 spacings.
sph::WorldDescription emptyScene();
/// With pressure and viscosity.
sph::WorldDescription bloodScene();
/// The same with a gravity of zero, which stays zero among all effects.
sph::WorldDescription weightlessScene();

void addBlock(sph::WorldDescription& scene, const sph::Vec3& lower, const Counts& counts,
              const sph::Vec3& velocity = sph::Vec3::Zero());
void addLoneParticle(sph::WorldDescription& scene, const sph::Vec3& at, const sph::Vec3& velocity = sph::Vec3::Zero());
/// Tissue around (0, 0, 0) to `counts` spacings; the domain reaches 20 spacings further.
void addBox(sph::WorldDescription& scene, const Counts& counts, bool open_top = false);
void addPlane(sph::WorldDescription& scene, const sph::Vec3& point, const sph::Vec3& normal);
/// A closed box, filled up to `depth` spacings, under gravity, that takes forces.
sph::WorldDescription poolScene(const Counts& box, int depth);
/// A disc wound at the origin of a plane, under gravity; m and m^3/s.
sph::WorldDescription woundScene(double radius, double flow);
sph::SetForce push(const sph::Vec3& at, double radius, const sph::Vec3& newtons);

/// Smallest distance of two particles, spacings; infinite with fewer than two.
double smallestDistance(Trial& trial);
double speedRms(const Trial& trial);  ///< m/s
/// By id, from 1 in the order of seeding.
std::vector<sph::Vec3> positionsById(Trial& trial);

}  // namespace bleedsim::lab
