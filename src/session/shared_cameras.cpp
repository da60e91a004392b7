// SPDX-License-Identifier: Apache-2.0
#include "session/shared_cameras.h"

#include <algorithm>
#include <utility>

#include "base/shown_name.h"
#include "geometry/calibration.h"
#include "geometry/screen.h"
#include "session/audit_action.h"
#include "session/audit_event.h"
#include "session/camera_offer.h"
#include "wire/condition_text.h"

namespace theatron::session {
using wire::TextCode;

void SharedCameras::add_own(std::vector<wire::Camera> cameras) {
    for (wire::Camera& camera : cameras)
        camera.session = session_;
    const std::vector<PlacedScreen> screens = place_screens({}, cameras, Placing::only_unplaced);
    streams_.add(host_publisher, std::move(cameras));
    for (const PlacedScreen& screen : screens)
        room_.add_screen(screen.camera, screen.offer, screen.chosen);
    set_budgets();
}

void SharedCameras::publish(ParticipantId id, const wire::Publish& offer) {
    const Admission::Participant& publisher = *admission_.find(id);
    std::vector<wire::Camera> cameras = cameras_of(offer, session_);
    if (wire::Text problem = problem_of_offer(id, publisher, streams_.cameras(), cameras);
        !problem.empty())
        return send(id, wire::Published{{}, std::move(problem)});
    // The publisher gets its cameras' numbers before the settings for them.
    wire::Published answer;
    for (std::size_t i = 0; i < cameras.size(); ++i)
        answer.cameras.push_back(streams_.cameras().next_id(i));
    send(id, std::move(answer));
    for (const wire::Camera& camera : cameras)
        actions_.push_back(audit_of(AuditEvent::What::shared, id, publisher, "", camera.name));
    const std::vector<PlacedScreen> screens =
        place_screens({id, publisher.name, publisher.person, {}, {}}, cameras, Placing::all);
    std::vector<std::string> given_names;
    for (const wire::Camera& camera : cameras)
        given_names.push_back(camera.name);
    name_cameras(id, cameras);
    streams_.add(id, std::move(cameras), publisher.given_name, given_names);
    for (const PlacedScreen& screen : screens)
        room_.add_screen(screen.camera, screen.offer, screen.chosen);
    take_media(id);
    set_budgets();
}

// As people's names are told apart. Not from those of the same person, whose earlier connection may
// still be there.
void SharedCameras::name_cameras(ParticipantId id, std::vector<wire::Camera>& cameras) const {
    const Admission::Participant& publisher = *admission_.find(id);
    std::vector<std::string> others{at_the_host};
    for (const auto& [number, camera] : streams_.cameras()) {
        const Admission::Participant* of = admission_.find(camera.publisher());
        const bool is_own = camera.publisher() == id ||
                            (of && !of->person.empty() && of->person == publisher.person);
        if (!is_own && !camera.is_face())
            others.push_back(camera.description().name);
    }
    std::vector<std::string> facts{"host", "recorded", "now", "Gastgeber", "jetzt"};
    for (int i = 0; i <= int(wire::CameraCondition::failed); ++i)
        facts.push_back(wire::text_of(wire::CameraCondition(i)));
    for (wire::Camera& camera : cameras) {
        // It is shown with the person.
        if (camera.kind == wire::CameraKind::face)
            continue;
        const std::string name = person_name(camera.name, facts, wire::max_name);
        camera.name = told_apart(name.empty() ? "camera" : name, others, wire::max_name);
    }
}

std::vector<SharedCameras::PlacedScreen> SharedCameras::place_screens(
    const ScreenOffer& offer, std::vector<wire::Camera>& cameras, Placing which) const {
    std::vector<PlacedScreen> screens;
    std::vector<HostRoom::ChosenPlace> places;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const auto calibration = decode_calibration(cameras[i].calibration);
        if (cameras[i].kind == wire::CameraKind::face || !calibration || !is_screen(*calibration) ||
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
        const CameraId id =
            which == Placing::only_unplaced ? cameras[i].id : streams_.cameras().next_id(i);
        screens.push_back({id, std::move(one), chosen});
    }
    return screens;
}

void SharedCameras::end_share(CameraId camera, ParticipantId by) {
    const CameraStreams* found = streams_.cameras().find(camera);
    if (!found || found->publisher() == host_publisher)
        return;
    const ParticipantId publisher = found->publisher();
    const std::string& name = admission_.find(by)->name;
    audit(AuditEvent::What::unshared, publisher, camera, name);
    look_back_.forget(camera, {});
    streams_.remove({camera}, Removal::decided);
    if (admission_.find(publisher)->has(wire::Feature::screens))
        send(publisher, wire::ShareEnded{{camera}, name});
    set_budgets();
}

void SharedCameras::unpublish(ParticipantId id, const wire::Unpublish& left) {
    std::vector<CameraId> own = streams_.cameras().of(id);
    std::erase_if(own, [&](CameraId camera) {
        return std::find(left.cameras.begin(), left.cameras.end(), camera) == left.cameras.end();
    });
    remove(id, own, Removal::decided);
}

void SharedCameras::remove(ParticipantId id, const std::vector<CameraId>& cameras, Removal why) {
    for (const CameraId camera : cameras)
        audit(AuditEvent::What::unshared, id, camera);
    for (const CameraId camera : cameras) {
        room_.remove_screen(camera);
        look_back_.forget(camera, {});
    }
    streams_.remove(cameras, why);
    paces_.clear();
    set_budgets();
}

void SharedCameras::on_state(ParticipantId id, const wire::CameraState& state) {
    const CameraStreams* camera = streams_.cameras().find(state.camera);
    if (camera && camera->publisher() == id)
        streams_.on_state(state);
}

// Lets the connection take messages as large as pictures of its cameras can be. The bound never
// shrinks: pictures of a camera that leaves may still be in flight.
void SharedCameras::take_media(ParticipantId id) {
    std::size_t& most = admission_.find(id)->max_media;
    for (const CameraId camera : streams_.cameras().of(id))
        if (const auto calibration =
                decode_calibration(streams_.cameras().find(camera)->description().calibration))
            most = std::max(most, max_media_size(*calibration));
    actions_.push_back(action::TakeMedia{id, most});
}

void SharedCameras::set_budgets() {
    for (auto& [id, participant] : admission_.participants())
        participant.budget.set_streams(2 * streams_.cameras().size());
}

SharedCameras::Received SharedCameras::on_media(ParticipantId id, ByteView message, TimePoint now) {
    Admission::Participant* participant = admission_.find(id);
    if (!participant || !participant->takes_part())
        return {};
    const auto header = wire::parse_media_header(message);
    if (!header)
        return {{}, {TextCode::damaged_picture, {std::string(to_text(header.error()))}}};
    const CameraStreams* camera = streams_.cameras().find(camera_of(header->stream));
    // A camera that has just left may still have pictures in flight; its number is not used again
    // for a while.
    if (!camera && streams_.cameras().was_given(camera_of(header->stream)))
        return {};
    if (!camera || camera->publisher() != id ||
        (!is_depth(header->stream) && !camera->description().has_color))
        return {{}, {TextCode::foreign_picture}};
    if (!lets_through(*participant, *camera, *header, message.size(), now))
        return {};
    look_back_.keep(*header, message, now);
    return {streams_.on_media(*header, message.size(), now), {}, *header};
}

// Pictures of settings that are gone are ignored later, as those of all cameras.
bool SharedCameras::lets_through(Admission::Participant& publisher, const CameraStreams& camera,
                                 const wire::MediaHeader& header, std::size_t size, TimePoint now) {
    const OwnPictureLimits* limits = own_picture_limits(camera.offered_as());
    if (!limits || !camera.table(is_depth(header.stream)).find(header.setting))
        return true;
    if (paces_.try_emplace(header.setting, *limits).first->second.take(now, size))
        return true;
    ++publisher.refused_pictures;
    return false;
}

void SharedCameras::audit(AuditEvent::What what, ParticipantId id, CameraId camera,
                          const std::string& by) {
    actions_.push_back(audit_of(what, id, *admission_.find(id), by,
                                streams_.cameras().find(camera)->description().name));
}

}  // namespace theatron::session
