// SPDX-License-Identifier: Apache-2.0
// Table 1 as one page of HTML with plots, for people who decide and people who review. The file
// needs no other file and no network.
#pragma once

#include <string>
#include <vector>

#include "table1.h"

namespace theatron::bench {

std::string table1_page(const Table1Measured& measured, const std::vector<Table1Row>& rows);

// Rows of one group and unit as SVG: the paper's figure, its method here and Theatron's choice on
// one logarithmic axis, with lines from the lowest to the highest run. Empty if no row has a
// figure.
std::string table1_plot(const std::vector<const Table1Row*>& rows);

}  // namespace theatron::bench
