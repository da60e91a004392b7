// SPDX-License-Identifier: Apache-2.0
// The last line of defence of a thread: an unexpected exception, above all lack of memory, ends the
// current piece of work and not the process.
#pragma once

#include <cstdint>
#include <exception>
#include <string_view>

namespace theatron {

// Counts the fault, and logs it unless `where` logged one within the last second.
void note_fault(std::string_view where, std::string_view what) noexcept;

// All faults of this process so far.
std::uint64_t fault_count();

// Runs `work`. False if it threw an exception, which is counted and logged.
template <class Work>
[[nodiscard]] bool contain(std::string_view where, Work&& work) noexcept {
    try {
        work();
        return true;
    } catch (const std::exception& e) {
        note_fault(where, e.what());
    } catch (...) {
        note_fault(where, "an exception of no known kind");
    }
    return false;
}

}  // namespace theatron
