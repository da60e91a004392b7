// SPDX-License-Identifier: Apache-2.0
#include "furniture/material.h"

namespace theatron::furniture {

render::SurfaceLook look_of(Material material) {
    switch (material) {
        case Material::enamel:
            return {{0.78, 0.79, 0.78}, 0, 0.28};
        case Material::grey_enamel:
            return {{0.42, 0.45, 0.47}, 0, 0.32};
        case Material::steel:
            return {{0.62, 0.63, 0.64}, 0.9, 0.36};
        case Material::chrome:
            return {{0.78, 0.79, 0.80}, 1, 0.16};
        case Material::white_plastic:
            return {{0.72, 0.72, 0.70}, 0, 0.5};
        case Material::grey_plastic:
            return {{0.24, 0.26, 0.28}, 0, 0.5};
        case Material::black_plastic:
            return {{0.025, 0.027, 0.03}, 0, 0.42};
        case Material::rubber:
            return {{0.05, 0.05, 0.055}, 0, 0.8};
        case Material::pad:
            return {{0.035, 0.04, 0.048}, 0, 0.55};
        case Material::green_cloth:
            return {{0.03, 0.20, 0.13}, 0, 0.95};
        case Material::blue_cloth:
            return {{0.06, 0.20, 0.36}, 0, 0.95};
        case Material::glass:
            return {{0.42, 0.53, 0.55}, 0, 0.08};
        case Material::screen:
            return {{0.008, 0.014, 0.022}, 0, 0.12};
        case Material::light:
            return {{0.97, 0.99, 1.0}, 0, 1, 1, 0, nullptr, true};
        case Material::diffuser:
            return {{0.80, 0.83, 0.83}, 0, 1, 1, 0, nullptr, true};
        case Material::yellow:
            return {{0.72, 0.47, 0.03}, 0, 0.45};
        case Material::red:
            return {{0.50, 0.04, 0.03}, 0, 0.45};
        case Material::blue:
            return {{0.05, 0.14, 0.45}, 0, 0.45};
        case Material::green:
            return {{0.05, 0.33, 0.16}, 0, 0.45};
        case Material::fluid:
            return {{0.62, 0.68, 0.66}, 0, 0.15};
    }
    return {};
}

bool shines(Material material) {
    return material == Material::light || material == Material::diffuser;
}

}  // namespace theatron::furniture
