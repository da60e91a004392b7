// SPDX-License-Identifier: Apache-2.0
#include "bench_network.h"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include "base/error.h"

namespace theatron::bench {

void enter_namespace(const std::string& name) {
    if (name.empty())
        return;
    const int file = open(("/run/netns/" + name).c_str(), O_RDONLY | O_CLOEXEC);
    const bool entered = file >= 0 && setns(file, CLONE_NEWNET) == 0;
    if (file >= 0)
        close(file);
    if (!entered)
        throw Error("Cannot enter the network namespace " + name + "; that needs root.");
}

}  // namespace theatron::bench
