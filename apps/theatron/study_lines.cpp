// SPDX-License-Identifier: Apache-2.0
#include "study_lines.h"

#include <charconv>
#include <sstream>

#include "base/log.h"
#include "base/output.h"
#include "files/json_text.h"

namespace theatron::app {
namespace {

const char* text_of(wire::StudyKind kind) {
    using Kind = wire::StudyKind;
    switch (kind) {
        case Kind::interrupted:
            return "interrupted";
        case Kind::consent:
            return "consent";
        case Kind::read:
            return "read";
        case Kind::watch:
            return "watch";
        case Kind::number:
            return "number";
        case Kind::yes_no:
            return "yes_no";
        case Kind::rating:
            return "rating";
        case Kind::choice:
            return "choice";
        case Kind::over:
            return "over";
    }
    return "unknown";
}

nlohmann::json texts_json(const std::vector<wire::StudyText>& texts) {
    nlohmann::json list = nlohmann::json::array();
    for (const wire::StudyText& text : texts)
        list.push_back(text.text);
    return list;
}

bool takes_value(wire::StudyKind kind) {
    using Kind = wire::StudyKind;
    return kind != Kind::read && kind != Kind::watch && kind != Kind::interrupted &&
           kind != Kind::over;
}

}  // namespace

const char* study_lines_help() {
    return "'study reply NUMBER' (yes is 1, no is 0), 'study done', 'study skip', 'study stop'";
}

bool obey_study_line(client::Participant& participant, const std::string& line) {
    std::istringstream words(line);
    std::string what, action, value, more;
    words >> what >> action >> value >> more;
    if (what != "study")
        return false;
    wire::StudyReply reply;
    const char* const end = value.data() + value.size();
    const auto [at, problem] = std::from_chars(value.data(), end, reply.value);
    const bool is_number = !value.empty() && problem == std::errc() && at == end;
    if (action == "skip")
        reply.action = wire::StudyAction::skip;
    else if (action == "stop")
        reply.action = wire::StudyAction::stop;
    const bool is_alone = action == "done" || action == "skip" || action == "stop";
    const bool is_right =
        more.empty() && (is_alone ? value.empty() : action == "reply" && is_number);
    const auto study = participant.study();
    if (!is_right)
        log::say(std::string("Say ") + study_lines_help() + ".");
    else if (!study)
        log::say("You take part in no study at present.");
    else if (action == "done" && takes_value(study->step.kind))
        log::say("This step asks for a reply: 'study reply NUMBER'.");
    else if (reply.step = study->step.step; !participant.reply_to_study(reply))
        log::say("You have not joined yet.");
    return true;
}

nlohmann::json study_json(const client::Participant& participant) {
    const auto study = participant.study();
    if (!study)
        return nullptr;
    const wire::StudyStep& step = study->step;
    return {{"step", step.step},
            {"steps", step.steps},
            {"kind", text_of(step.kind)},
            {"texts", texts_json(step.texts)},
            {"choices", texts_json(step.choices)},
            {"anchors", {step.left, step.right}},
            {"lowest", step.lowest},
            {"highest", step.highest},
            {"step_size", step.step_size},
            {"watch_s", to_seconds(step.watch)},
            {"limit_s", to_seconds(step.limit)},
            {"problem", step.problem}};
}

void StudyLines::on_tick(const client::Participant& participant) {
    const auto study = participant.study();
    if (!study || study->version == version_)
        return;
    version_ = study->version;
    output::print(files::json_text(nlohmann::json{{"study", study_json(participant)}}) + "\n");
}

}  // namespace theatron::app
