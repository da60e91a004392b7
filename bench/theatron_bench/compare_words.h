// SPDX-License-Identifier: Apache-2.0
// How alike two pictures are, in words for people who know neither PSNR nor SSIM. The words are
// Theatron's own; no standard has them.
#pragma once

#include <string>

namespace theatron::bench {

// "small differences"
std::string psnr_words(double db);
std::string ssim_words(double ssim);

// Where each of these words begins, as one sentence.
std::string psnr_scale();
std::string ssim_scale();

}  // namespace theatron::bench
