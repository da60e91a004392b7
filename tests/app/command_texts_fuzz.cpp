// SPDX-License-Identifier: Apache-2.0
// Any text for a region, a person or a view, as on the command line and on standard input:
// something that the cameras' lanes and the renderers may be given, or one sentence.
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/camera_names.h"
#include "base/error.h"
#include "region_text.h"
#include "viewer/head_text.h"
#include "viewer/view_choice.h"

namespace {

// Calls `parse` and passes its result to `check`. An Error of `parse` must have a text.
template <class Parse, class Check>
void try_text(const Parse& parse, const Check& check) {
    try {
        check(parse());
    } catch (const theatron::Error& sentence) {
        if (std::string(sentence.what()).empty())
            std::abort();
    }
}

void require(bool holds) {
    if (!holds)
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace theatron;
    const std::string text(reinterpret_cast<const char*>(data), size);
    try_text([&] { return app::parse_region(text); },
             [](const app::RegionText& region) {
                 require(!region.camera.empty());
                 require(codec::strata::is_valid({region.polygon}));
             });
    try_text(
        [&] {
            return find_camera(text, {"left", "right"});
        },
        [](std::size_t camera) { require(camera < 2); });
    for (const viewer::Seen who : {viewer::Seen::other, viewer::Seen::oneself})
        try_text([&] { return viewer::parse_seen_person(text, who); },
                 [](const viewer::SeenPerson& person) {
                     const Vec3 eyes = person.room_from_head * Vec3{0, 0, 0};
                     require(std::isfinite(eyes.x + eyes.y + eyes.z));
                     require(std::isfinite(person.reach_m) && person.reach_m > 0);
                 });
    try_text([&] { return viewer::parse_view(text); },
             [](const viewer::ViewChoice& view) {
                 require(std::abs(view.yaw_degrees) <= 180 && std::abs(view.pitch_degrees) <= 80);
             });
    return 0;
}
