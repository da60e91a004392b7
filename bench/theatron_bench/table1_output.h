// SPDX-License-Identifier: Apache-2.0
// Table 1 for people at a terminal, for scripts and for spreadsheets.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "table1.h"

namespace theatron::bench {

// The table with numbered notes below it. Lines end with \n.
std::string table1_text(const Table1Measured& measured, const std::vector<Table1Row>& rows);

// {paper:{title,machine}, here:{processor,cores,gl_renderer,cores_of_others,runs,frames,
// part_seconds:{NAME:seconds}, yardstick:{name,encode_ms,decode_ms,kb}},
// stages:[{until,what,mean_ms}], bytes_per_kb, rows:[{id,group,name,unit,paper:{low,high},
// same,best,input,device,not_comparable:[]}]}. `same` and `best`: {ran,median,low,high,runs} or
// {ran,reason}, or null; `paper` is null where the paper gives no figure, `gl_renderer` and
// `yardstick` where there is none.
nlohmann::json table1_json(const Table1Measured& measured, const std::vector<Table1Row>& rows);

// One line for each row behind a line of names, as RFC 4180 says, with \n.
std::string table1_csv(const std::vector<Table1Row>& rows);

// All sentences of `not_comparable`, each once, in the order of the rows.
std::vector<std::string> notes_of(const std::vector<Table1Row>& rows);
// The numbers of a row's sentences in `notes`, from 1.
std::vector<int> note_numbers(const Table1Row& row, const std::vector<std::string>& notes);

// Figures as people read them: three digits that count; empty, "22 to 29", "1.34".
std::string figure_text(double value);
std::string paper_text(const Table1Row& row);
// "2.25 (2.2 to 2.3)" with several runs; "-" without a spread.
std::string spread_text(const Table1Cell& cell);
// The machine and the amounts, one sentence each.
std::vector<std::string> table1_remarks(const Table1Measured& measured);

}  // namespace theatron::bench
