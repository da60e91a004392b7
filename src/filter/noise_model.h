// SPDX-License-Identifier: Apache-2.0
// The noise of a depth camera as a function of distance.
#pragma once

namespace theatron::filter {

// Standard deviation of one measurement: constant + squared * (distance in metres)^2.
// The defaults are those of an Azure Kinect on surfaces of medium reflectivity
// (docs/filters.md).
struct NoiseModel {
    double constant_mm = 0.5;
    double squared_mm = 0.25;

    bool operator==(const NoiseModel&) const = default;
};

}  // namespace theatron::filter
