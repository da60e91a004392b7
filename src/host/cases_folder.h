// SPDX-License-Identifier: Apache-2.0
// Advice on a folder for --cases that holds no case.
#pragma once

#include <filesystem>
#include <string>

namespace theatron::host {

// A sentence if the folder holds other things than cases, as a folder of DICOM files does, or is a
// case itself; empty if it is empty, as cases may be put there later, or holds a case.
std::string advice_on_cases_folder(const std::filesystem::path& folder);

}  // namespace theatron::host
