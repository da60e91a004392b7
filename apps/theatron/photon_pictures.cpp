// SPDX-License-Identifier: Apache-2.0
#include "photon_pictures.h"

#include <optional>

#include "base/error.h"
#include "base/log.h"
#include "base/steady_clock.h"
#include "capture/camera.h"
#include "cli/progress.h"
#include "client/participant.h"
#include "join_pictures.h"
#include "link_argument.h"
#include "video/jpeg_decoder.h"
#include "viewer/offscreen_view_native.h"
#include "viewer/renderer_text.h"

namespace theatron::app {
namespace {

constexpr Duration picture_wait = 100ms;
// A frame that waits for that of another camera is shown this much late at most.
constexpr Duration partner_wait = 2ms;

client::Participant::Options photon_options(const PhotonRead& wanted) {
    client::Participant::Options join;
    join.link = parse_link_argument(wanted.sources.front());
    join.name = "photon";
    join.depth_codec = wanted.depth_codec;
    join.color_codec = wanted.color_codec;
    join.remark = [](const std::string& text) { log::say(text); };
    join.keeps_room = true;
    return join;
}

class SessionPictures final : public PhotonPictures {
public:
    explicit SessionPictures(const PhotonRead& wanted)
        : view_(viewer::parse_view(wanted.view)),
          size_(parse_size(wanted.size)),
          renderer_(wanted.renderer),
          participant_(photon_options(wanted)) {
        viewer::check_renderer_choice(renderer_);
    }

    const ColorImage* next() override {
        (void)participant_.wait_for_frame(scene_.waits() ? partner_wait : picture_wait);
        const bool is_new = scene_.take(participant_);
        const auto status = participant_.status();
        using Phase = client::Participant::Phase;
        if (status.phase == Phase::refused || status.phase == Phase::ended)
            throw Error(status.problem.empty() ? "The session has ended." : status.problem);
        if (!is_new || !scene_.can_draw(view_))
            return nullptr;
        const TimePoint uploaded = steady_now();
        picture_ = scene_.picture(
            {view_, size_, viewer::renderer_for(renderer_, scene_.cameras()), {}, {}});
        keep_times(uploaded, steady_now(), status.clock_known);
        return &picture_;
    }
    const FrameTimes* times() const override { return times_ ? &*times_ : nullptr; }

private:
    void keep_times(TimePoint uploaded, TimePoint presented, bool clock_known) {
        times_.reset();
        const receive::CameraFramePtr frame = scene_.newest(view_.camera);
        if (!clock_known || !frame)
            return;
        times_ = frame->times;
        times_->uploaded = participant_.session_time(uploaded);
        times_->presented = participant_.session_time(presented);
    }

    const viewer::ViewChoice view_;
    const Size size_;
    const std::string renderer_;
    viewer::OffscreenView scene_{viewer::RoomChoice{}};
    client::Participant participant_;
    ColorImage picture_;
    std::optional<FrameTimes> times_;
};

class CameraPictures final : public PhotonPictures {
public:
    explicit CameraPictures(const std::string& camera)
        : camera_(capture::open_camera(camera, cli::show_progress())) {
        if (camera_->info().calibration.color.size == Size{})
            throw Error("The camera '" + camera + "' has no colour, so no strip can be read.");
    }

    const ColorImage* next() override {
        const capture::Capture got = camera_->next(picture_wait);
        using Kind = capture::Capture::Kind;
        if (got.kind == Kind::failed)
            throw Error(got.problem);
        if (got.kind == Kind::end)
            throw Error(
                "The recording has ended; a recording has no age. Measure films with "
                "'theatron photon film'.");
        if (got.kind == Kind::nothing)
            return nullptr;
        frame_ = got.frame;
        const ColorData& color = frame_->color;
        if (!color.is_jpeg())
            return color.pixels.empty() ? nullptr : &color.pixels;
        return decoder_.decode(color.jpeg, decoded_) == Status::ok ? &decoded_ : nullptr;
    }

private:
    std::unique_ptr<capture::Camera> camera_;
    FramePtr frame_;
    video::BaselineJpegDecoder decoder_;
    ColorImage decoded_;
};

}  // namespace

std::unique_ptr<PhotonPictures> session_pictures(const PhotonRead& wanted) {
    return std::make_unique<SessionPictures>(wanted);
}

std::unique_ptr<PhotonPictures> camera_pictures(const std::string& camera) {
    return std::make_unique<CameraPictures>(camera);
}

}  // namespace theatron::app
