// SPDX-License-Identifier: Apache-2.0
#include "publish/distinct_names.h"

#include <algorithm>
#include <set>

namespace theatron::publish {

std::vector<std::string> distinct_names(std::vector<std::string> names) {
    const std::set<std::string> given(names.begin(), names.end());
    std::set<std::string> used;
    for (std::string& name : names) {
        const std::string own = name;
        for (int n = 2; used.contains(name) || (name != own && given.contains(name)); ++n)
            name = own + " (" + std::to_string(n) + ")";
        used.insert(name);
    }
    return names;
}

}  // namespace theatron::publish
