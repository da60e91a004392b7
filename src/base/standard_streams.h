// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace theatron {

// Takes the descriptors of standard input, output and error where they are closed, so that no file
// of the program gets one of their numbers, and with it what is meant for people. Reading and
// writing them fails as before. Call it first in main().
void reserve_standard_streams();

}  // namespace theatron
