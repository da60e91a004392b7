// SPDX-License-Identifier: Apache-2.0
#include "export/screen_json.h"

namespace theatron::exporting {

nlohmann::json screen_json(const session::SharedScreen& screen) {
    return {{"camera", screen.camera ? nlohmann::json(int(*screen.camera)) : nlohmann::json()},
            {"name", screen.name},
            {"publisher", screen.publisher},
            {"pinned", screen.pinned}};
}

}  // namespace theatron::exporting
