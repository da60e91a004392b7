// SPDX-License-Identifier: Apache-2.0
// Counts the errors that a GL driver reports through its debug output.
#pragma once

#include <string>

namespace theatron::render {

class GlErrors {
public:
    GlErrors() = default;
    GlErrors(const GlErrors&) = delete;  // the driver keeps this object's address
    GlErrors& operator=(const GlErrors&) = delete;

    // Registers this object for the current context's debug output, if it has
    // one. This object must outlive the context.
    void watch();

    int count() const { return count_; }
    const std::string& first() const { return first_; }

    void add(const char* message);

private:
    int count_ = 0;
    std::string first_;
};

}  // namespace theatron::render
