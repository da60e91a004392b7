// SPDX-License-Identifier: Apache-2.0
// Cameras of participants: offers, messages and pictures.
#include <algorithm>
#include <utility>

#include "geometry/calibration.h"
#include "session/announced_cameras.h"
#include "session/host_session.h"

namespace theatron::session {
namespace {

using wire::TextCode;

// No codec makes a picture much larger than its pixels (receive::max_media_size).
std::size_t max_media_size(Size size) {
    constexpr std::size_t overhead = 64 * 1024, bytes_per_pixel = 4;
    return wire::media_header_size + overhead + bytes_per_pixel * size.area();
}

}  // namespace

void HostSession::carry_out(ParticipantId id, const wire::Publish& offer, TimePoint) {
    std::vector<wire::Camera> cameras;
    for (const wire::OfferedCamera& offered : offer.cameras) {
        wire::Camera camera;
        camera.name = offered.name;
        camera.has_color = offered.has_color;
        camera.frames_per_second = offered.frames_per_second;
        camera.calibration = offered.calibration;
        camera.may_record = offered.may_record;
        camera.session = config_.session;
        camera.frame = offered.frame;
        cameras.push_back(std::move(camera));
    }
    if (wire::Text problem = problem_of(id, offer, cameras); !problem.empty())
        return send(id, wire::Published{{}, std::move(problem)});
    // The publisher gets its cameras' numbers before the settings for them.
    wire::Published answer;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        answer.cameras.push_back(streams_.next_id(i));
    send(id, std::move(answer));
    for (const wire::Camera& camera : cameras)
        audit(AuditEvent::What::shared, id, "", camera.name);
    streams_.add(id, std::move(cameras), admission_.find(id)->name);
    take_media(id);
    set_budgets();
}

// The reason why these cameras cannot join the session; empty if they can.
wire::Text HostSession::problem_of(ParticipantId id, const wire::Publish& offer,
                                   const std::vector<wire::Camera>& cameras) const {
    if (!admission_.participants().at(id).has(wire::Feature::publish))
        return {TextCode::link_without_cameras};
    if (offer.cameras.empty())
        return {TextCode::no_camera_offered};
    if (streams_.of(id).size() + cameras.size() > max_published)
        return {TextCode::too_many_own_cameras, {std::to_string(max_published)}};
    if (streams_.size() + cameras.size() > wire::max_cameras)
        return {TextCode::session_full, {std::to_string(wire::max_cameras)}};
    if (!streams_.has_numbers_for(cameras.size()))
        return {TextCode::no_camera_numbers};
    // The same check as in every participant.
    std::vector<wire::Camera> all = streams_.cameras();
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        all.push_back(cameras[i]);
        all.back().id = streams_.next_id(i);
        all.back().depth_stream = depth_stream(all.back().id);
        all.back().color_stream = color_stream(all.back().id);
    }
    const AnnouncedCameras judged = judge_cameras(std::move(all));
    return judged.left_out.empty() ? wire::Text() : judged.left_out.back();
}

void HostSession::carry_out(ParticipantId id, const wire::Unpublish& left, TimePoint) {
    std::vector<CameraId> own = streams_.of(id);
    std::erase_if(own, [&](CameraId camera) {
        return std::find(left.cameras.begin(), left.cameras.end(), camera) == left.cameras.end();
    });
    unshare(id, own);
}

void HostSession::unshare(ParticipantId id, const std::vector<CameraId>& cameras) {
    for (const CameraId camera : cameras)
        audit(AuditEvent::What::unshared, id, "", streams_.find(camera)->description().name);
    for (const CameraId camera : cameras)
        look_back_.forget(camera, {});
    streams_.remove(cameras);
    set_budgets();
}

void HostSession::carry_out(ParticipantId id, const wire::CameraState& state, TimePoint) {
    const CameraStreams* camera = streams_.find(state.camera);
    if (camera && camera->publisher() == id)
        streams_.on_state(state);
}

// Lets the connection take messages as large as pictures of its cameras can be. The bound never
// shrinks: pictures of a camera that leaves may still be in flight.
void HostSession::take_media(ParticipantId id) {
    std::size_t& most = admission_.find(id)->max_media;
    for (const CameraId camera : streams_.of(id))
        if (const auto calibration =
                decode_calibration(streams_.find(camera)->description().calibration))
            most = std::max({most, max_media_size(calibration->depth.size),
                             max_media_size(calibration->color.size)});
    actions_.push_back(action::TakeMedia{id, most});
}

void HostSession::set_budgets() {
    for (auto& [id, participant] : admission_.participants())
        participant.budget.set_streams(2 * streams_.size());
}

std::vector<ParticipantId> HostSession::on_media_from(ParticipantId id, ByteView message,
                                                      TimePoint now) {
    const Participant* participant = admission_.find(id);
    if (!participant || !participant->takes_part())
        return {};
    const auto header = wire::parse_media_header(message);
    if (!header) {
        refuse(id, {TextCode::damaged_picture, {std::string(to_text(header.error()))}});
        return {};
    }
    const CameraStreams* camera = streams_.find(camera_of(header->stream));
    // A camera that has just left may still have pictures in flight; its number is not used again.
    if (!camera && camera_of(header->stream) < streams_.next_id(0))
        return {};
    if (!camera || camera->publisher() != id ||
        (!is_depth(header->stream) && !camera->description().has_color)) {
        refuse(id, {TextCode::foreign_picture});
        return {};
    }
    look_back_.keep(*header, message, now);
    return streams_.on_media(*header, message.size(), now);
}

}  // namespace theatron::session
