// SPDX-License-Identifier: Apache-2.0
// Cameras of participants: offers, messages and pictures.
#include <algorithm>
#include <utility>

#include "geometry/calibration.h"
#include "geometry/screen.h"
#include "session/camera_offer.h"
#include "session/host_session.h"

namespace theatron::session {
using wire::TextCode;

void HostSession::carry_out(ParticipantId id, const wire::Publish& offer, TimePoint) {
    const Participant& publisher = *admission_.find(id);
    std::vector<wire::Camera> cameras = cameras_of(offer, config_.session);
    if (wire::Text problem = problem_of_offer(id, publisher, streams_.cameras(), cameras);
        !problem.empty())
        return send(id, wire::Published{{}, std::move(problem)});
    // The publisher gets its cameras' numbers before the settings for them.
    wire::Published answer;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        answer.cameras.push_back(streams_.cameras().next_id(i));
    send(id, std::move(answer));
    for (const wire::Camera& camera : cameras)
        audit(AuditEvent::What::shared, id, "", camera.name);
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
        screens.push_back({streams_.cameras().next_id(i), std::move(one), chosen});
    }
    return screens;
}

void HostSession::end_share(CameraId camera, ParticipantId by) {
    const CameraStreams* found = streams_.cameras().find(camera);
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

void HostSession::carry_out(ParticipantId id, const wire::Unpublish& left, TimePoint) {
    std::vector<CameraId> own = streams_.cameras().of(id);
    std::erase_if(own, [&](CameraId camera) {
        return std::find(left.cameras.begin(), left.cameras.end(), camera) == left.cameras.end();
    });
    unshare(id, own);
}

void HostSession::unshare(ParticipantId id, const std::vector<CameraId>& cameras) {
    for (const CameraId camera : cameras)
        audit(AuditEvent::What::unshared, id, "",
              streams_.cameras().find(camera)->description().name);
    for (const CameraId camera : cameras) {
        room_.remove_screen(camera);
        look_back_.forget(camera, {});
    }
    streams_.remove(cameras);
    face_paces_.clear();
    set_budgets();
}

void HostSession::carry_out(ParticipantId id, const wire::CameraState& state, TimePoint) {
    const CameraStreams* camera = streams_.cameras().find(state.camera);
    if (camera && camera->publisher() == id)
        streams_.on_state(state);
}

// Lets the connection take messages as large as pictures of its cameras can be. The bound never
// shrinks: pictures of a camera that leaves may still be in flight.
void HostSession::take_media(ParticipantId id) {
    std::size_t& most = admission_.find(id)->max_media;
    for (const CameraId camera : streams_.cameras().of(id))
        if (const auto calibration =
                decode_calibration(streams_.cameras().find(camera)->description().calibration))
            most = std::max(most, max_media_size(*calibration));
    actions_.push_back(action::TakeMedia{id, most});
}

void HostSession::set_budgets() {
    for (auto& [id, participant] : admission_.participants())
        participant.budget.set_streams(2 * streams_.cameras().size());
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
    const CameraStreams* camera = streams_.cameras().find(camera_of(header->stream));
    // A camera that has just left may still have pictures in flight; its number is not used again.
    if (!camera && camera_of(header->stream) < streams_.cameras().next_id(0))
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
