// SPDX-License-Identifier: Apache-2.0
#include "session/request_kinds.h"

#include <type_traits>
#include <variant>

namespace theatron::session {
namespace {

using Kind = RequestBudget::Kind;

// One for each kind of message, so that a new one cannot be forgotten.
struct KindOf {
    Kind operator()(const wire::Join&) const { return Kind::other; }
    Kind operator()(const wire::ChooseCodecs&) const { return Kind::codecs; }
    Kind operator()(const wire::ChooseDelivery&) const { return Kind::delivery; }
    Kind operator()(const wire::RequestKey&) const { return Kind::key; }
    Kind operator()(const wire::Ping&) const { return Kind::ping; }
    Kind operator()(const wire::Report&) const { return Kind::report; }
    Kind operator()(const wire::Publish&) const { return Kind::publish; }
    Kind operator()(const wire::Unpublish&) const { return Kind::publish; }
    Kind operator()(const wire::CameraState&) const { return Kind::state; }
    Kind operator()(const wire::RoomRequest&) const { return Kind::room; }
    Kind operator()(const wire::Manage&) const { return Kind::manage; }
    Kind operator()(const wire::RequestContent&) const { return Kind::content; }
    Kind operator()(const wire::VoiceConsent&) const { return Kind::other; }
    Kind operator()(const wire::AdjustCamera&) const { return Kind::manage; }
    Kind operator()(const wire::Play&) const { return Kind::manage; }
    Kind operator()(const wire::LookBack&) const { return Kind::manage; }
    Kind operator()(const wire::OfferRelay&) const { return Kind::publish; }
    Kind operator()(const wire::RelayReport&) const { return Kind::report; }
    Kind operator()(const wire::AskPatient&) const { return Kind::other; }
    Kind operator()(const wire::ShowStudy&) const { return Kind::manage; }
    Kind operator()(const wire::StudyReply&) const { return Kind::room; }
    Kind operator()(const wire::SetCondition&) const { return Kind::manage; }
    Kind operator()(const wire::WriteChat&) const { return Kind::chat; }
    Kind operator()(const wire::RaiseHand&) const { return Kind::other; }
};

// One for each kind of message and no default: a forgotten one does not compile.
struct RightOf {
    // Participants who have joined send no further Join.
    Right operator()(const wire::Join&) const { return Right::see; }
    Right operator()(const wire::ChooseCodecs&) const { return Right::see; }
    Right operator()(const wire::ChooseDelivery&) const { return Right::see; }
    Right operator()(const wire::RequestKey&) const { return Right::see; }
    Right operator()(const wire::Ping&) const { return Right::take_part; }
    Right operator()(const wire::Report&) const { return Right::see; }
    Right operator()(const wire::Publish& offer) const { return needed_right(offer); }
    // These two concern the sender's own cameras only.
    Right operator()(const wire::Unpublish&) const { return Right::be_seen; }
    Right operator()(const wire::CameraState&) const { return Right::be_seen; }
    Right operator()(const wire::RoomRequest& request) const { return needed_right(request); }
    Right operator()(const wire::Manage&) const { return Right::manage; }
    Right operator()(const wire::RequestContent&) const { return Right::see; }
    // Everybody may be silent.
    Right operator()(const wire::VoiceConsent&) const { return Right::see; }
    Right operator()(const wire::AdjustCamera&) const { return Right::adjust; }
    Right operator()(const wire::Play&) const { return Right::play; }
    Right operator()(const wire::LookBack&) const { return Right::see; }
    Right operator()(const wire::OfferRelay&) const { return Right::relay; }
    Right operator()(const wire::RelayReport&) const { return Right::relay; }
    // Those who may open a case; what they are told is decided by OfferedCases.
    Right operator()(const wire::AskPatient&) const { return Right::handle; }
    Right operator()(const wire::ShowStudy&) const { return Right::manage; }
    // An observer may be the participant of a study.
    Right operator()(const wire::StudyReply&) const { return Right::see; }
    Right operator()(const wire::SetCondition&) const { return Right::manage; }
    Right operator()(const wire::WriteChat&) const { return Right::write; }
    // A muted person may ask to be heard.
    Right operator()(const wire::RaiseHand&) const { return Right::see; }
};

template <class Message>
concept Decision =
    std::is_same_v<Message, wire::Manage> || std::is_same_v<Message, wire::AdjustCamera> ||
    std::is_same_v<Message, wire::Play> || std::is_same_v<Message, wire::LookBack> ||
    std::is_same_v<Message, wire::ShowStudy> || std::is_same_v<Message, wire::SetCondition>;

}  // namespace

RequestBudget::Kind kind_of(const wire::ToHost& message) {
    return std::visit(KindOf{}, message);
}

Right right_needed_for(const wire::ToHost& message) {
    return std::visit(RightOf{}, message);
}

std::uint32_t decision_number(const wire::ToHost& message) {
    return std::visit(
        [](const auto& m) -> std::uint32_t {
            if constexpr (Decision<std::decay_t<decltype(m)>>)
                return m.number;
            return 0;
        },
        message);
}

}  // namespace theatron::session
