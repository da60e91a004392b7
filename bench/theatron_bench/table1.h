// SPDX-License-Identifier: Apache-2.0
// Table 1 of Fischer et al., "Evaluation of Point Cloud Streaming and Rendering for VR-based
// Telepresence in the OR" (EuroXR 2022), beside measurements of the same rows here.
//
// Pure: nothing here measures. table1_measure.h fills Table1Measured, table1_rows() puts it beside
// the paper's figures, table1_output.h and table1_page.h write the result.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "image/view.h"
#include "photon/stages.h"

namespace theatron::bench {

// The camera pictures of the paper: depth, and colour registered to it.
inline constexpr Size paper_full{640, 576}, paper_cropped{540, 476};
inline constexpr const char* paper_title =
    "Fischer et al., Evaluation of Point Cloud Streaming and Rendering for VR-based Telepresence "
    "in the OR (EuroXR 2022), Table 1 and text";
inline constexpr const char* paper_machine =
    "Intel i7-7800X, GeForce RTX 2070, Windows 10, Unreal Engine 4.26, HTC Vive Pro Eye, Azure "
    "Kinect";
// As in the paper; other pages of Theatron's documentation have 1000.
inline constexpr double bytes_per_kb = 1024;

enum class Table1Input {
    depth_full,
    depth_cropped,
    color_full,
    color_cropped,
    both_full,
    both_cropped,
    one_camera,
    two_cameras,
    session,
    strip,
    none
};
// The part of a machine on which a figure depends.
enum class Table1Device { none, thread, gpu, machine };

// One row as the paper has it, and the measurements that belong beside it. A measurement is named
// by a key such as "depth/full/trvl/encode_ms", and empty where none belongs there.
struct Table1Line {
    std::string id, group, name, unit;
    double paper_low = 0, paper_high = 0;  // equal but for ranges; 0: the paper gives none
    struct Way {
        std::string key, ran;  // the measurement, and what ran, in words
    };
    Way same, best;  // the paper's method; Theatron's own choice
    Table1Input input = Table1Input::none;
    Table1Device device = Table1Device::none;
    std::vector<std::string> differences;  // why it cannot be compared, beyond size and device
};
std::vector<Table1Line> table1_lines();

// All that was measured.
struct Table1Measured {
    std::map<std::string, std::vector<double>> samples;  // by key, one a run
    // Why there is no sample, in a sentence, by the beginning of the keys.
    std::map<std::string, std::string> reasons;
    std::map<Table1Input, std::string> inputs;  // what it is, in words
    std::map<Table1Input, Size> sizes;          // of its pictures
    std::string processor;
    int cores = 0;
    std::string gpu;  // the GL driver's name for it; empty: no GL
    // The mean age of a drawn picture of a synthetic camera, stage by stage; empty: not measured.
    std::vector<photon::Stage> stages;
    double cores_of_others = 0;  // busy with other programs before the first run
    int runs = 0, frames = 0;    // asked for
    // How long each part took in all runs together, in their order; wall clock.
    std::vector<std::pair<std::string, double>> part_seconds;
};

// The median of the runs, the lowest and the highest.
struct Table1Spread {
    double median = 0, low = 0, high = 0;
    int runs = 0;
};

struct Table1Cell {
    std::string ran;
    std::optional<Table1Spread> spread;
    std::string reason;  // why there is none; empty with one, or if nothing belongs there
};

struct Table1Row {
    std::string id, group, name, unit;
    std::optional<double> paper_low, paper_high;
    Table1Cell same, best;
    std::string input, device;
    std::vector<std::string> not_comparable;  // sentences
};

// All rows, in the order of table1_lines(). Each cell has a spread or a reason, unless it is empty
// by its line.
std::vector<Table1Row> table1_rows(const Table1Measured& measured);

}  // namespace theatron::bench
