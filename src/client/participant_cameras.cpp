// SPDX-License-Identifier: Apache-2.0
// The cameras of the session, as the host describes them.
#include <algorithm>
#include <utility>

#include "base/steady_clock.h"
#include "client/participant_figures.h"
#include "client/participant_shared.h"
#include "geometry/screen.h"
#include "wire/sentence.h"

namespace theatron::client {
namespace {

// The session's cameras, with the states that `before` knows.
std::vector<Participant::Camera> described_cameras(const session::ViewerSession& session,
                                                   const std::vector<Participant::Camera>& before) {
    std::vector<Participant::Camera> cameras;
    for (const wire::Camera& camera : session.cameras()) {
        const auto calibration = decode_calibration(camera.calibration);
        const auto known = std::find_if(before.begin(), before.end(), [&](const auto& c) {
            return c.description.id == camera.id;
        });
        Participant::Camera& added = cameras.emplace_back();
        added.description = camera;
        added.calibration = calibration.value();
        added.state.camera = camera.id;
        if (known == before.end())
            continue;
        added.state = known->state;
        added.told_problem = known->told_problem;
    }
    return cameras;
}

std::string publisher_of(const Participant::Camera& camera) {
    return std::to_string(std::uint32_t(camera.description.publisher));
}

}  // namespace

// A new connection: numbers of settings may start again.
void Participant::on_welcome() {
    const std::uint64_t generation = decoders_->set_cameras(session_.cameras());
    std::unique_lock lock(shared_->mutex);
    shared_->cameras = described_cameras(session_, {});
    ++shared_->generation;
    shared_->decoder_generation = generation;
    shared_->newest.clear();
    shared_->settings.clear();
    // Otherwise the host says the session's state again on the same connection.
    const bool is_new = std::exchange(shared_->status.phase, Phase::joined) != Phase::joined;
    shared_->status.problem.clear();
    shared_->status.publish_problem.clear();
    shared_->status.face_problem.clear();
    shared_->status.screen_problem.clear();
    shared_->status.host_name = session_.welcome().host_name;
    shared_->status.delivery = {};
    shared_->may_adjust = session_.has(wire::Feature::adjusting);
    shared_->can_look_back = session_.has(wire::Feature::look_back);
    shared_->status.has_room = session_.has(wire::Feature::room);
    shared_->playback.reset();
    shared_->patient = shared_->asked_patient = {};
    shared_->may_ask_patient = session_.has(wire::Feature::asks_patient);
    shared_->may_lead_study = session_.has(wire::Feature::study);
    shared_->renderer_command = wire::SetRenderer{};
    shared_->room.begin(session_.welcome().participant);
    shared_->status.joins += is_new;
    const bool again = is_new && shared_->status.joins > 1;
    compare_cameras();
    lock.unlock();
    if (is_new)
        upload_.on_joined();
    if (!session_.may_publish() && !numbers(Offer::cameras).empty())
        forget_numbers(Offer::cameras);
    for (const wire::Text& problem : session_.left_out())
        remark(wire::sentence(problem));
    ping(steady_now());
    // Not where only messages were lost: the host still has them.
    offered_.clear();
    for (const Offer offer : all_offers)
        if (numbers(offer).empty())
            offer_cameras(offer);
    announce();
    if (again)
        remark(say(Phrase::connected_again));
    if (options_.described)
        options_.described();
}

void Participant::on_cameras() {
    for (const wire::Text& problem : session_.left_out())
        remark(wire::sentence(problem));
    std::vector<std::string> news;
    decoders_->change_cameras(session_.cameras());
    {
        const std::lock_guard lock(shared_->mutex);
        std::vector<Camera> cameras = described_cameras(session_, shared_->cameras);
        const auto without = [](const std::vector<Camera>& all, CameraId id) {
            return std::none_of(all.begin(), all.end(),
                                [&](const Camera& c) { return c.description.id == id; });
        };
        const auto is_face = [](const Camera& camera) {
            return camera.description.kind == wire::CameraKind::face;
        };
        for (const Camera& camera : cameras)
            if (without(shared_->cameras, camera.description.id) && !is_face(camera))
                shared_->add_remark(news, publisher_of(camera),
                                    say(is_screen(camera.calibration) ? Phrase::screen_joined
                                                                      : Phrase::camera_joined,
                                        camera.description.name));
        const std::vector<CameraId>& interrupted = session_.interrupted();
        for (const Camera& camera : shared_->cameras)
            if (without(cameras, camera.description.id) && !is_face(camera)) {
                const bool broke = std::find(interrupted.begin(), interrupted.end(),
                                             camera.description.id) != interrupted.end();
                shared_->add_remark(news, publisher_of(camera),
                                    say(broke ? Phrase::camera_interrupted : Phrase::camera_left,
                                        camera.description.name));
            }
        shared_->cameras = std::move(cameras);
        shared_->settings = session_.settings();
        ++shared_->generation;
        compare_cameras();
        std::erase_if(shared_->newest,
                      [&](const auto& entry) { return without(shared_->cameras, entry.first); });
    }
    for (const std::string& text : news)
        remark(text);
    announce();
    if (options_.interrupted && !session_.interrupted().empty())
        options_.interrupted(session_.interrupted());
    if (options_.described)
        options_.described();
}

// The cameras of the room, which are shown together. The shared mutex is held.
void Participant::compare_cameras() {
    compared_.clear();
    for (const Camera& camera : shared_->cameras)
        if (camera.description.kind == wire::CameraKind::room && !is_screen(camera.calibration))
            compared_[camera.description.id] = camera.description.publisher;
}

// Where the host leaves frames out, it does so camera by camera: pictures that come alone are no
// fault of a camera.
void Participant::note_moment(const wire::MediaHeader& header) {
    if (session_.delivery().level > 0)
        return;
    const auto compared = compared_.find(camera_of(header.stream));
    const auto& settings = session_.settings();
    const auto setting =
        std::find_if(settings.begin(), settings.end(),
                     [&](const wire::StreamSetting& one) { return one.stream == header.stream; });
    if (compared == compared_.end() || (setting != settings.end() && setting->past))
        return;
    moments_.add(compared->second, compared->first, header.moment, header.captured);
}

void Participant::on_camera_states() {
    std::vector<std::string> news;
    {
        const std::lock_guard lock(shared_->mutex);
        for (Camera& camera : shared_->cameras) {
            const auto found = session_.camera_states().find(camera.description.id);
            if (found == session_.camera_states().end())
                continue;
            const wire::CameraCondition before =
                std::exchange(camera.state, found->second).condition;
            using Condition = wire::CameraCondition;
            const std::string& name = camera.description.name;
            const auto add = [&](const std::string& text) {
                shared_->add_remark(news, publisher_of(camera), text);
            };
            const std::string problem = problem_text(camera.state, shared_->status.standing.role);
            const bool is_live = camera.state.condition == Condition::live;
            // The problem that it had before its pictures stood still is not told again.
            const bool is_news = is_live && camera.told_problem != camera.state.problem.code;
            if (is_live)
                camera.told_problem = camera.state.problem.code;
            if (is_news && !problem.empty())
                add(say(Phrase::camera_problem, name, problem));
            else if (is_news)
                add(say(Phrase::camera_well, name));
            // Faces come and go; people see it.
            if (camera.state.condition == before ||
                camera.description.kind == wire::CameraKind::face)
                continue;
            if (camera.state.condition == Condition::ended)
                add(say(Phrase::camera_ended, name));
            else if (camera.state.condition == Condition::failed)
                add(say(Phrase::camera_failed, name, problem));
            else if (camera.state.condition == Condition::stale)
                add(say(Phrase::camera_stale, name, problem));
            else
                add(say(Phrase::camera_live_again, name));
        }
    }
    for (const std::string& text : news)
        remark(text);
}

}  // namespace theatron::client
