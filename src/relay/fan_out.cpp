// SPDX-License-Identifier: Apache-2.0
#include "relay/fan_out.h"

#include <algorithm>
#include <utility>

namespace theatron::relay {

void FanOut::set_wishes(Wishes wishes, TimePoint now) {
    wishes_ = std::move(wishes);
    std::set<SettingId> wanted;
    for (const auto& [id, settings] : wishes_)
        for (const auto& [setting, layer] : settings)
            wanted.insert(setting);
    const auto is_unwanted = [&](const auto& entry) { return !wanted.contains(entry.first); };
    std::erase_if(chains_, is_unwanted);
    std::erase_if(asked_at_, is_unwanted);
    std::erase_if(asked_, [&](SettingId setting) { return !wanted.contains(setting); });
    for (auto& [id, receiver] : receivers_) {
        const std::map<SettingId, int>& settings = wishes_[id];
        std::erase_if(receiver.streams,
                      [&](const auto& entry) { return !settings.contains(entry.first); });
        for (const auto& [setting, layer] : settings)
            if (!receiver.streams.contains(setting))
                begin(id, receiver, setting, now);
    }
}

void FanOut::come(ParticipantId id, TimePoint now) {
    Receiver& receiver = receivers_[id] = {};
    for (const auto& [setting, layer] : wishes_[id])
        begin(id, receiver, setting, now);
}

// From the chain that there is, or from the next key frame on.
void FanOut::begin(ParticipantId id, Receiver& receiver, SettingId setting, TimePoint now) {
    Stream& stream = receiver.streams[setting];
    stream = {};
    const auto chain = chains_.find(setting);
    if (chain == chains_.end() || chain->second.frames.empty() ||
        now - chain->second.begun > chain_age)
        return ask(setting);
    stream = {State::catches_up, chain->second.number, 0};
    // Opens layer 0, of which chains are.
    (void)receiver.gate.passes(chain->second.stream, 0, wishes_[id][setting]);
    catch_up(id, receiver, setting);
}

void FanOut::catch_up(ParticipantId id, Receiver& receiver, SettingId setting) {
    Stream& stream = receiver.streams[setting];
    const auto found = chains_.find(setting);
    while (stream.state == State::catches_up) {
        if (found == chains_.end() || found->second.frames.empty()) {
            stream.state = State::waits;
            return ask(setting);
        }
        const Chain& chain = found->second;
        if (chain.number != stream.chain)
            stream = {State::catches_up, chain.number, 0};
        if (stream.next == chain.frames.size()) {
            stream.state = State::live;
            // Frames of upper layers may refer to some that were not sent.
            receiver.gate.forget(chain.stream);
            return;
        }
        if (port_.is_behind(id, chain.stream))
            return;  // on_left() goes on
        // A frame that begins to leave at once brings on_left() before push() returns.
        const Frame& next = chain.frames[stream.next++];
        if (!push(id, stream, next))
            return ask(setting);
    }
}

// False: the frame is lost, and the stream waits for a key frame.
bool FanOut::push(ParticipantId id, Stream& stream, const Frame& frame) {
    const wire::MediaHeader& header = frame.header;
    const auto pushed = port_.send(id, {frame.message,
                                        header.stream,
                                        header.setting,
                                        header.frame,
                                        header.reference,
                                        header.temporal_layer,
                                        header.key,
                                        {}});
    if (pushed.needs_key)
        stream.state = State::waits;
    return !pushed.needs_key;
}

void FanOut::note(Chain& chain, const wire::MediaHeader& header,
                  std::shared_ptr<const Bytes> message, TimePoint now) {
    const std::size_t size = message->size();
    if (chain.has_come) {
        // Over about two seconds.
        const double seconds = std::max(to_seconds(now - chain.newest), 0.001);
        const double weight = std::min(seconds / 2, 1.0);
        chain.bytes_per_second += weight * (double(size) / seconds - chain.bytes_per_second);
    }
    chain.has_come = true;
    chain.newest = now;
    chain.stream = header.stream;
    // Where frames do not refer to one another, those of layer 0 are for everybody.
    if (header.key && (header.temporal_layer == 0 || chain.frames.empty())) {
        chain.clear();
        ++chain.number;
        chain.begun = now;
    } else if (header.key || header.temporal_layer > 0) {
        return;
    } else if (chain.frames.empty() || chain.frames.back().header.frame != header.reference ||
               chain.frames.size() >= max_chain_frames || chain.bytes + size > max_chain_bytes) {
        return chain.clear();
    }
    chain.bytes += size;
    chain.frames.push_back({header, std::move(message)});
}

void FanOut::on_media(const wire::MediaHeader& header, std::shared_ptr<const Bytes> message,
                      TimePoint now) {
    note(chains_[header.setting], header, message, now);
    if (header.key)
        asked_.erase(header.setting);
    const Frame frame{header, std::move(message)};
    for (auto& [id, receiver] : receivers_) {
        const auto found = receiver.streams.find(header.setting);
        if (found == receiver.streams.end())
            continue;
        Stream& stream = found->second;
        if (!receiver.gate.passes(header.stream, header.temporal_layer,
                                  wishes_[id][header.setting]))
            continue;
        if (stream.state == State::catches_up)
            catch_up(id, receiver, header.setting);  // the frame may be the last of the chain
        else if (stream.state == State::live || header.key) {
            stream.state = State::live;
            if (!push(id, stream, frame))
                ask(header.setting);
        } else {
            ask(header.setting);
        }
    }
}

void FanOut::on_lost() {
    for (auto& [setting, chain] : chains_)
        chain.clear();
    for (auto& [id, receiver] : receivers_)
        for (auto& [setting, stream] : receiver.streams) {
            stream.state = State::waits;
            ask(setting);
        }
}

void FanOut::on_left(ParticipantId id) {
    const auto found = receivers_.find(id);
    if (found == receivers_.end())
        return;
    for (auto& [setting, stream] : found->second.streams)
        if (stream.state == State::catches_up)
            catch_up(id, found->second, setting);
}

Duration FanOut::interval_of(const Chain& chain) const {
    if (chain.frames.empty() || chain.bytes_per_second <= 0)
        return key_interval;
    const double key = double(chain.frames.front().message->size());
    return std::clamp(seconds_to_duration(key / (key_share * chain.bytes_per_second)), key_interval,
                      longest_key_interval);
}

std::vector<session::KeyRequests::Key> FanOut::take_keys(TimePoint now) {
    std::vector<session::KeyRequests::Key> keys;
    for (const SettingId setting : asked_) {
        const auto chain = chains_.find(setting);
        // Nothing has come yet of a setting that is new: the host sends a key frame by itself, and
        // its stream is not known here.
        if (chain == chains_.end() || !chain->second.has_come)
            continue;
        const auto last = asked_at_.find(setting);
        if (last != asked_at_.end() && now - last->second < interval_of(chain->second))
            continue;
        asked_at_[setting] = now;
        keys.push_back({chain->second.stream, setting});
    }
    return keys;
}

std::size_t FanOut::cached_bytes() const {
    std::size_t bytes = 0;
    for (const auto& [setting, chain] : chains_)
        bytes += chain.bytes;
    return bytes;
}

}  // namespace theatron::relay
