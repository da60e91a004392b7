// SPDX-License-Identifier: Apache-2.0
#include "frame_reader.h"

namespace theatron::python {
namespace {

class RecordingReader final : public FrameReader {
public:
    RecordingReader(std::shared_ptr<const record::RecordingFile> recording, std::size_t camera,
                    std::string file)
        : recording_(std::move(recording)), camera_(camera), file_(std::move(file)) {
        begin_part(0);  // throws where there is no such camera
        parts_ = capture::calibrations_of(recording_->cameras()[camera_]);
    }

    Answer next(TakenFrame& out) override {
        while (true) {
            const std::optional<Duration> offset = frames_->offset();
            if (!offset) {
                if (part_ + 1 == parts_)
                    return Answer::end;
                finish_part();
                begin_part(part_ + 1);
                continue;
            }
            const wire::MediaHeader header = frames_->upcoming();
            out.utc = frames_->upcoming_utc();
            std::shared_ptr<Frame> frame = pool_.take();
            if (!frames_->read(*frame))
                continue;
            frame->number = header.frame;
            frame->times = {};
            frame->times.captured = header.captured;
            out.camera = view_;
            out.frame = std::move(frame);
            out.is_own = true;
            out.seconds = to_seconds(*offset);
            out.moment_us = to_us(header.moment);
            return Answer::frame;
        }
    }

    void seek(Duration time) override {
        losses_ = {};
        for (std::size_t part = 0; part < parts_; ++part) {
            begin_part(part);
            frames_->go_to(time);
            auto offset = frames_->offset();
            for (; offset && *offset < time; offset = frames_->offset())
                frames_->skip();
            if (offset)
                return;
        }
    }

    capture::PictureLosses losses() const override {
        capture::PictureLosses all = sum(losses_, frames_->losses());
        all.damaged_color += view_->undecoded();
        return all;
    }

    std::string problem_at_end() const override { return frames_->problem_at_end(); }

private:
    static capture::PictureLosses sum(capture::PictureLosses a, const capture::PictureLosses& b) {
        a.damaged_depth += b.damaged_depth;
        a.damaged_color += b.damaged_color;
        a.undecodable_depth += b.undecodable_depth;
        a.undecodable_color += b.undecodable_color;
        return a;
    }

    void begin_part(std::size_t part) {
        frames_ = std::make_unique<capture::RecordedFrames>(recording_, camera_, file_, part);
        part_ = part;
        view_ = std::make_shared<const CameraView>(int(camera_), frames_->info().name,
                                                   frames_->info().calibration);
    }

    void finish_part() { losses_ = losses(); }

    const std::shared_ptr<const record::RecordingFile> recording_;
    const std::size_t camera_;
    const std::string file_;
    std::size_t parts_ = 1;  // by calibration
    std::size_t part_ = 0;
    std::unique_ptr<capture::RecordedFrames> frames_;  // of the part
    std::shared_ptr<const CameraView> view_;           // of the part
    capture::PictureLosses losses_;                    // in the parts before
    FramePool pool_;
};

}  // namespace

std::unique_ptr<FrameReader> read_recording(std::shared_ptr<const record::RecordingFile> recording,
                                            std::size_t camera, const std::string& file) {
    return std::make_unique<RecordingReader>(std::move(recording), camera, file);
}

}  // namespace theatron::python
