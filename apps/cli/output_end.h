// SPDX-License-Identifier: Apache-2.0
// The end of a program whose output others read.
#pragma once

namespace theatron::cli {

// Writing to a terminal or pipe whose reader is gone fails from now on, instead of ending the
// program.
void outlive_readers();

// Waits for the readers of standard output and standard error, but not long: a second for lines,
// ten for results (base/output.h), and a second after a signal to stop. False if a result could not
// be written.
bool finish_output();

}  // namespace theatron::cli
