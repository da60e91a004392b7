// SPDX-License-Identifier: Apache-2.0
// The operating table: column, sections, mattress, rails.
#include "synthetic/scene.h"

namespace theatron::synthetic {

void add_table(Mesh& still) {
    const auto put = [&](F3 centre, F3 size, Look look, float bevel) {
        still.append(make_box(size, bevel, look), translation(centre));
    };
    put({0.05f, 0.06f, 0}, {1.05f, 0.1f, 0.5f}, Look::grey_plastic, 0.03f);
    put({0.05f, 0.125f, 0}, {0.7f, 0.06f, 0.4f}, Look::steel, 0.025f);
    put({0.0f, 0.45f, 0}, {0.34f, 0.62f, 0.26f}, Look::steel, 0.03f);
    put({0.0f, 0.76f, 0}, {0.5f, 0.08f, 0.4f}, Look::grey_plastic, 0.02f);
    for (int i = 0; i < 4; ++i) {
        const float x = -0.78f + 0.54f * float(i);
        put({x, 0.825f, 0}, {0.525f, 0.04f, 0.5f}, Look::painted_metal, 0.008f);
        put({x, 0.88f, 0}, {0.53f, 0.075f, 0.52f}, Look::mattress, 0.025f);
        for (const float s : {-1.0f, 1.0f})
            put({x, 0.815f, s * 0.275f}, {0.48f, 0.028f, 0.01f}, Look::steel, 0.003f);
    }
    // The frame that holds up the sheet at the patient's head.
    for (const float s : {-1.0f, 1.0f})
        still.append(make_tube({{-0.66f, 0.82f, s * 0.3f}, {-0.66f, 1.5f, s * 0.3f}}, {0.011f}, 12,
                               Look::steel));
    still.append(
        make_tube({{-0.66f, 1.5f, -0.4f}, {-0.66f, 1.5f, 0.4f}}, {0.011f}, 12, Look::steel));
}

}  // namespace theatron::synthetic
