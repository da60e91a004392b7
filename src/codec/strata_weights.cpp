// SPDX-License-Identifier: Apache-2.0
#include "codec/strata_weights.h"

#include <algorithm>
#include <cmath>

namespace theatron::codec::strata {

Weights solve(const Equations& equations, int taps) {
    double a[tap_count][tap_count + 1] = {};
    for (int i = 0, at = 0; i < taps; ++i) {
        for (int j = i; j <= taps; ++j, ++at) {
            a[i][j] = equations[at];
            if (j < taps)
                a[j][i] = equations[at];
        }
    }
    // Gauss-Jordan elimination; the diagonal is regularised, so that unused taps get 0.
    for (int i = 0; i < taps; ++i)
        a[i][i] += 1 + a[i][i] * 1e-4;
    for (int i = 0; i < taps; ++i) {
        const double pivot = a[i][i];
        for (int j = i; j <= taps; ++j)
            a[i][j] /= pivot;
        for (int k = 0; k < taps; ++k) {
            const double factor = a[k][i];
            if (k == i || factor == 0)
                continue;
            for (int j = i; j <= taps; ++j)
                a[k][j] -= factor * a[i][j];
        }
    }
    Weights weights{};
    for (int i = 0; i < taps; ++i) {
        const double scaled = std::isfinite(a[i][taps]) ? std::round(a[i][taps] * 32768) : 0;
        weights[i] = std::int16_t(std::clamp(scaled, -32767.0, 32767.0));
    }
    return weights;
}

}  // namespace theatron::codec::strata
