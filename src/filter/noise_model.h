// SPDX-License-Identifier: Apache-2.0
// How much a depth camera's measurements scatter, by distance.
#pragma once

namespace theatron::filter {

// Standard deviation of one measurement: constant + squared * (distance in metres)^2.
// The usual values are those of an Azure Kinect on surfaces of middling
// reflectivity (docs/filters.md).
struct NoiseModel {
    double constant_mm = 0.5;
    double squared_mm = 0.25;

    bool operator==(const NoiseModel&) const = default;
};

}  // namespace theatron::filter
