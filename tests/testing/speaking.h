// SPDX-License-Identifier: Apache-2.0
// For tests of texts in other languages: the program speaks one for a while.
#pragma once

#include "phrases/language.h"

namespace theatron::testing {

class Speaking {
public:
    explicit Speaking(Language other) : before_(language()) { set_language(other); }
    ~Speaking() { set_language(before_); }
    Speaking(const Speaking&) = delete;
    Speaking& operator=(const Speaking&) = delete;

private:
    Language before_;
};

}  // namespace theatron::testing
