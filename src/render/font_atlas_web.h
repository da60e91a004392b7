// SPDX-License-Identifier: Apache-2.0
// The letters of a browser's page, made once for all its visits, and bit by bit: together they
// would hold the page up for some tenths of a second.
#pragma once

namespace theatron::render {

// Makes some letters, in a few milliseconds, until all are there. True from then on, when
// load_font_atlas() answers at once.
bool prepare_font_atlas();

}  // namespace theatron::render
