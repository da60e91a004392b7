// SPDX-License-Identifier: Apache-2.0
// Cameras of participants: offers, messages and pictures.
#include <algorithm>
#include <utility>

#include "geometry/calibration.h"
#include "geometry/screen.h"
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
    const Participant& publisher = *admission_.find(id);
    const std::vector<PlacedScreen> screens =
        place_screens({id, publisher.name, publisher.person, {}, {}}, cameras);
    streams_.add(id, std::move(cameras), publisher.given_name);
    for (const PlacedScreen& screen : screens)
        room_.add_screen(screen.camera, screen.offer, screen.chosen);
    take_media(id);
    set_budgets();
}

std::vector<HostSession::PlacedScreen> HostSession::place_screens(
    const ScreenOffer& offer, std::vector<wire::Camera>& cameras, Placing which) const {
    std::vector<PlacedScreen> screens;
    std::vector<HostRoom::ChosenPlace> places;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const auto calibration = decode_calibration(cameras[i].calibration);
        if (cameras[i].frame == wire::CameraFrame::face || !calibration ||
            !is_screen(*calibration) ||
            (which == Placing::only_unplaced && calibration->registered))
            continue;
        ScreenOffer one = offer;
        one.name = cameras[i].name;
        one.calibration = *calibration;
        const HostRoom::ChosenPlace chosen = room_.place_screen(one, places);
        const ScreenPlace& place = chosen.place;
        cameras[i].calibration = encode_calibration(
            screen_calibration(calibration->color.size, place.width_m, place.room_from_screen));
        places.push_back(chosen);
        screens.push_back({streams_.next_id(i), std::move(one), chosen});
    }
    return screens;
}

void HostSession::end_share(CameraId camera, ParticipantId by) {
    const CameraStreams* found = streams_.find(camera);
    if (!found || found->publisher() == host_publisher)
        return;
    const ParticipantId publisher = found->publisher();
    const std::string& name = admission_.find(by)->name;
    audit(AuditEvent::What::unshared, publisher, name, found->description().name);
    look_back_.forget(camera, {});
    streams_.remove({camera});
    if (admission_.find(publisher)->has(wire::Feature::screens))
        send(publisher, wire::ShareEnded{{camera}, name});
    set_budgets();
}

// The same for the faces among them, of which there are so many.
wire::Text HostSession::problem_of_faces(ParticipantId id, const std::vector<wire::Camera>& cameras,
                                         std::size_t new_faces) const {
    if (!admission_.participants().at(id).has(wire::Feature::webcam))
        return {TextCode::face_forbidden};
    for (const wire::Camera& camera : cameras) {
        if (camera.frame != wire::CameraFrame::face)
            continue;
        const auto calibration = decode_calibration(camera.calibration);
        if (!camera.has_color || !calibration || !is_face(*calibration, camera.frames_per_second))
            return {TextCode::face_beyond_limits,
                    {std::to_string(max_face_pixels), std::to_string(int(max_face_fps))}};
    }
    const std::vector<CameraId> own = streams_.of(id);
    const bool has_one = std::any_of(
        own.begin(), own.end(), [&](CameraId camera) { return streams_.find(camera)->is_face(); });
    if (new_faces > 1 || has_one)
        return {TextCode::one_face};
    if (streams_.faces() >= max_faces)
        return {TextCode::too_many_faces, {std::to_string(max_faces)}};
    return {};
}

// The reason why these cameras cannot join the session; empty if they can.
wire::Text HostSession::problem_of(ParticipantId id, const wire::Publish& offer,
                                   const std::vector<wire::Camera>& cameras) const {
    const Participant& publisher = admission_.participants().at(id);
    if (offer.cameras.empty())
        return {TextCode::no_camera_offered};
    const auto new_faces =
        std::size_t(std::count_if(cameras.begin(), cameras.end(), [](const wire::Camera& camera) {
            return camera.frame == wire::CameraFrame::face;
        }));
    if (new_faces < cameras.size() && !publisher.has(wire::Feature::publish))
        return {TextCode::link_without_cameras};
    if (new_faces > 0)
        if (wire::Text problem = problem_of_faces(id, cameras, new_faces); !problem.empty())
            return problem;
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
    for (const CameraId camera : cameras) {
        room_.remove_screen(camera);
        look_back_.forget(camera, {});
    }
    streams_.remove(cameras);
    face_paces_.clear();
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
    Participant* participant = admission_.find(id);
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
    if (camera->is_face() &&
        !lets_face_through(*participant, *camera, *header, message.size(), now))
        return {};
    look_back_.keep(*header, message, now);
    std::vector<ParticipantId> receivers = streams_.on_media(*header, message.size(), now);
    std::erase_if(receivers,
                  [&](ParticipantId receiver) { return !direct_.is_relayed(receiver, *header); });
    return receivers;
}

void HostSession::carry_out(ParticipantId id, const wire::OfferDirect& offer, TimePoint) {
    direct_.offer(id, offer);
}

// In the same step as the change, so that a receiver that was removed gets nothing more.
void HostSession::follow_paths() {
    const bool have_streams_changed =
        std::exchange(streams_seen_, streams_.changes()) != streams_.changes();
    if ((!direct_.take_change() && !have_streams_changed) || !direct_.is_used())
        return;
    std::vector<StreamUse> uses = streams_.uses();
    if (!look_back_.is_possible())
        for (StreamUse& use : uses)
            use.is_kept = false;
    for (const KeyRequests::Key& key : direct_.follow(uses))
        streams_.request_key(key.stream, key.setting);
}

// Pictures of settings that are gone are ignored later, as those of all cameras.
bool HostSession::lets_face_through(Participant& publisher, const CameraStreams& camera,
                                    const wire::MediaHeader& header, std::size_t size,
                                    TimePoint now) {
    if (!camera.table(is_depth(header.stream)).find(header.setting))
        return true;
    if (size <= max_face_message && face_paces_[header.setting].take(now))
        return true;
    ++publisher.refused_faces;
    return false;
}

}  // namespace theatron::session
