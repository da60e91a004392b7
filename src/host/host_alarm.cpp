// SPDX-License-Identifier: Apache-2.0
// The alarm of the server's thread: for poses, and for pictures of those who look back.
#include <utility>

#include "base/steady_clock.h"
#include "host/host_impl.h"

namespace theatron::host {

// For what is due first.
void Host::Impl::set_alarm() {
    auto due = poses.due();
    if (const auto past = session->past_due(); past && (!due || *past < *due))
        due = past;
    if (!due || alarm_at == due)
        return;
    alarm_at = due;
    server->set_alarm(*due);
}

void Host::Impl::on_alarm() {
    alarm_at.reset();
    if (const auto due = poses.due(); due && *due <= steady_now())
        send_poses();
    send_past();
    set_alarm();
}

void Host::Impl::send_past() {
    std::vector<session::LookBacks::Due> pictures = session->take_past(steady_now());
    carry_out();  // settings come before their pictures
    for (session::LookBacks::Due& picture : pictures) {
        const wire::MediaHeader& header = picture.header;
        // Where the link is too slow, the next key frame of the past continues the stream.
        const auto pushed = server->send_media(net::PeerId(std::uint32_t(picture.receiver)),
                                               media_of(header, std::move(picture.message)));
        dropped_slow[camera_of(header.stream)] += std::uint64_t(pushed.dropped);
    }
}

}  // namespace theatron::host
