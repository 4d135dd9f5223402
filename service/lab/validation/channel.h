// Blood between or over plane walls, and its velocity profile.
#pragma once

#include "service/lab/validation/case_world.h"

namespace bleedsim::lab {

using Profile = std::function<double(double)>;  ///< speed at a height, m/s

/// Blood `rows` spacings and `depth` m deep on the plane z = 0, periodic along x and y, under the acceleration `force`. With a
/// lid also between. Pressure, and viscosity solved explicitly.
sph::WorldDescription channelScene(const Knobs& knobs, int rows, double depth, bool lid, const sph::Vec3& force,
                                   double design_speed);

/// The rows' mean u_x, at their middles.
std::vector<double> rowSpeeds(const sph::World& world, int rows);

/// L2 of the rows against `exact` at their middles, relative to that of `exact`.
double profileError(const std::vector<double>& speeds, double spacing, const Profile& exact);

/// Found and exact profile, for a plot; `name` tells them apart.
void addProfile(picture::LinePlot& plot, const std::string& name, const std::vector<double>& speeds, double spacing,
                const Profile& exact);

}  // namespace bleedsim::lab
