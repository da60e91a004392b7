// SPDX-License-Identifier: Apache-2.0
// Folders, which are read as fast as they can be, and cameras at their own pace.
#include "base/error.h"
#include "capture/folder_camera.h"
#include "frame_reader.h"

namespace theatron::python {
namespace {

class FolderReader final : public FrameReader {
public:
    explicit FolderReader(Options options) : pictures_(capture::open_folder_pictures(options)) {
        view_ =
            std::make_shared<const CameraView>(0, pictures_.info.name, pictures_.info.calibration);
    }

    Answer next(TakenFrame& out) override {
        while (const std::optional<Duration> offset = pictures_.recording->offset()) {
            std::shared_ptr<Frame> frame = pool_.take();
            const FrameNumber number = number_++;
            if (!pictures_.recording->read(*frame))
                continue;
            frame->number = number;
            frame->times = {};
            frame->times.captured = TimePoint(*offset);
            out = {.camera = view_,
                   .frame = std::move(frame),
                   .is_own = true,
                   .seconds = to_seconds(*offset),
                   .moment_us = offset->count()};
            return Answer::frame;
        }
        return Answer::end;
    }

    void seek(Duration time) override {
        pictures_.recording->rewind();
        number_ = 0;
        for (auto offset = pictures_.recording->offset(); offset && *offset < time;
             offset = pictures_.recording->offset()) {
            pictures_.recording->skip();
            ++number_;
        }
    }

    // Files do not tell which of a frame's pictures is damaged, so all count as depth.
    capture::PictureLosses losses() const override {
        return {.damaged_depth = pictures_.recording->lost_pictures(),
                .damaged_color = view_->undecoded()};
    }

private:
    capture::FolderPictures pictures_;
    std::shared_ptr<const CameraView> view_;
    FrameNumber number_ = 0;
    FramePool pool_;
};

class CameraReader final : public FrameReader {
public:
    CameraReader(std::unique_ptr<capture::Camera> camera, bool every) : camera_(std::move(camera)) {
        if (every && !camera_->skip_none())
            throw Error(
                "This camera cannot wait, so that late frames are skipped: open it without "
                "every=True.");
        view_ = std::make_shared<const CameraView>(0, camera_->info().name,
                                                   camera_->info().calibration);
    }

    Answer next(TakenFrame& out) override {
        const capture::Capture capture = camera_->next(patience);
        switch (capture.kind) {
            case capture::Capture::Kind::nothing:
                return Answer::nothing;
            case capture::Capture::Kind::end:
                problem_ = capture.problem;
                return Answer::end;
            case capture::Capture::Kind::failed:
                throw Error(capture.problem);
            case capture::Capture::Kind::frame:
                break;
        }
        const TimePoint captured = capture.frame->times.captured;
        if (!first_)
            first_ = captured;
        out = {.camera = view_,
               .frame = capture.frame,
               .is_own = false,
               .seconds = to_seconds(captured - *first_),
               .moment_us = to_us(captured)};
        return Answer::frame;
    }

    void seek(Duration) override {
        throw Error(
            "A camera gives its frames when they are due; open the file with Recording or "
            "Folder to go to a time.");
    }

    capture::PictureLosses losses() const override {
        return {.damaged_depth = camera_->lost_pictures(), .damaged_color = view_->undecoded()};
    }
    std::string problem_at_end() const override { return problem_; }

private:
    static constexpr Duration patience = std::chrono::milliseconds(100);

    std::unique_ptr<capture::Camera> camera_;
    std::shared_ptr<const CameraView> view_;
    std::optional<TimePoint> first_;
    std::string problem_;
};

}  // namespace

std::unique_ptr<FrameReader> read_folder(Options options) {
    return std::make_unique<FolderReader>(std::move(options));
}

std::unique_ptr<FrameReader> read_camera(std::unique_ptr<capture::Camera> camera, bool every) {
    return std::make_unique<CameraReader>(std::move(camera), every);
}

}  // namespace theatron::python
