// SPDX-License-Identifier: Apache-2.0
// Ways in which an expert elsewhere can see an operation, beside each other: a video call, a
// published pipeline, a general codec for point clouds, and Theatron.
//
// Pure data: compare_measure.h fills Compared, compare_output.h and compare_page.h write it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare_link.h"
#include "image/image.h"

namespace theatron::bench {

// Drawn pictures beside the exact ones.
struct CompareLikeness {
    double psnr_db = 0, ssim = 0;       // of the pixels whose surface a camera sees
    double holes_percent = 0;           // share of these without that surface: render::Holes
    double undrawn_percent = 0;         // share of the whole picture in which nothing is drawn
    double undrawn_unseen_percent = 0;  // the part of undrawn_percent whose surface no camera sees
    // Share of what is drawn that is not the surface there but something behind: render::Holes.
    double see_through_percent = 0;
};

// Why surfaces are missing, in percent of the same pixels; together they are the missing share.
struct CompareCauses {
    double no_camera = 0;  // no camera sees the surface
    double sensor = 0;     // a camera sees it and does not measure it
    double filters = 0;    // measured, and lost by filters
    double drawing = 0;    // there when the picture was drawn
    double sum() const { return no_camera + sensor + filters + drawing; }
};

// A camera's picture that came back, beside what the camera sees.
struct CompareOwnView {
    double psnr_db = 0, ssim = 0;
};

// Tells if the expert is shown a surface.
enum class Seen : std::uint8_t {
    nothing_there,  // no surface in this pixel
    rightly,        // it is shown
    wrongly,        // something else is shown in its place, without a mark
    hidden          // nothing is shown, or no camera of a video call sees it
};

// Each pixel of the exact close-up.
struct CompareSights {
    Image<Seen> seen;
    Image<float> detail_mm;  // of a pixel of the finest camera that sees the surface; 0: none does
};

// The same, summed over the surfaces of a region. The first three are 100 together.
struct CompareShares {
    double rightly_percent = 0, wrongly_percent = 0, hidden_percent = 0;
    double finely_percent = 0;  // rightly, and by a camera with pixels of 1 mm or less there
    double detail_mm = 0;       // median over what is shown rightly; 0: nothing is
};

struct CompareWound {
    CompareShares near, whole;  // close to the wound, and over the whole close-up
    // The causes of what is not shown rightly close to the wound; none of a video call or a pair.
    std::optional<CompareCauses> lost;
};

// The same few decimetres around the operation, from the first place of the expert or as a part of
// a camera's picture.
struct CompareCloseUp {
    ColorImage picture;
    std::optional<CompareLikeness> likeness;   // none of a camera's picture
    std::optional<CompareCauses> see_through;  // of CompareLikeness::see_through_percent
    // Shares of instruments' surfaces, whether a camera sees them or not: nothing or something more
    // than 2 cm behind is drawn.
    std::optional<CompareCauses> instruments;
};

struct CompareMethod {
    std::string id;         // stable, for scripts
    std::string name;       // for people who know no codec
    std::string plain;      // what it does, one sentence for them
    std::string ran;        // for people who know codecs
    std::string reason;     // why there are no figures at all; empty if there are some
    bool is_video = false;  // shows cameras' pictures and nothing from another place
    bool is_pair = false;   // two other ways at once; its pictures are theirs
    int cameras = 0;
    double mbit_per_camera = 0;    // at 30 pictures a second, without the first picture
    double rate_setting_mbit = 0;  // the rate that its encoder was set to; 0: it was set to none
    // Processor time of one camera's picture, and of a picture of all cameras.
    double sender_ms = 0, receiver_ms = 0, sender_of_all_ms = 0, receiver_of_all_ms = 0;
    double drawing_ms = 0;  // on the clock: upload and drawing of a picture of all cameras
    std::string drawn_on;   // by what; empty: not measured
    std::vector<LinkFigures> links;
    std::optional<CompareOwnView> own_view;
    std::optional<CompareLikeness> expert;    // over all places
    std::vector<CompareLikeness> from_place;  // from each of them
    std::string expert_reason;                // why there is no picture from the expert's place
    // From each place of the expert; one picture if it is the same from all, none without any.
    std::vector<ColorImage> pictures;
    std::optional<CompareCloseUp> close_up;
    std::optional<CompareSights> sights;  // in the close-up
    std::optional<CompareWound> wound;

    bool is_measured() const { return reason.empty(); }
    double mbit_of_all() const { return mbit_per_camera * cameras; }
};

struct Compared {
    std::string processor;
    int cores = 0;
    double cores_of_others = 0;  // busy with other programs before the first measurement
    std::string gl_renderer;     // empty: no GL
    int cameras = 0, frames = 0;
    Size depth, color, picture;
    std::vector<CompareLink> links;
    std::vector<std::string> places;  // of the expert, in words
    std::vector<ColorImage> truth;    // from each of them
    ColorImage close_up_truth;
    double close_up_width_m = 0;     // of what close-ups show
    double near_wound_m = 0;         // across the region close to the wound
    Image<std::uint8_t> near_wound;  // not 0 in the pixels of this region in the close-up
    std::vector<CompareMethod> methods;

    const CompareMethod* find(const std::string& id) const {
        for (const CompareMethod& method : methods)
            if (method.id == id)
                return &method;
        return nullptr;
    }
    // Null, too, if that method could not be measured.
    const CompareMethod* find_measured(const std::string& id) const {
        const CompareMethod* method = find(id);
        return method != nullptr && method->is_measured() ? method : nullptr;
    }
};

inline constexpr double compare_pictures_per_s = 30;
inline constexpr const char *video_call_id = "video_call", *full_hd_call_id = "video_call_full_hd",
                            *zoomed_call_id = "video_call_zoomed",
                            *two_camera_call_id = "video_call_two_cameras", *paper_id = "paper",
                            *pcl_id = "pcl", *theatron_id = "theatron",
                            *theatron_near_id = "theatron_near",
                            *theatron_and_call_id = "theatron_and_zoomed_call";

}  // namespace theatron::bench
