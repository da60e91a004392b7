// SPDX-License-Identifier: Apache-2.0
// The congestion control by which the kernel sends on a TCP socket. It belongs to the sender.
//
// CUBIC, which Linux usually takes, reads a lost packet as a full link: with a round trip of 40 ms
// and 1 % of packets lost it sends 3.5 Mbit/s on a link of any rate (1.2 segments per round trip
// and root of the loss: Mathis et al., ACM SIGCOMM CCR 27(3), 1997, to which CUBIC keeps on short
// round trips). BBR (Cardwell et al., ACM Queue 14(5), 2016) measures the link's rate instead.
// Linux offers it to every program once the module tcp_bbr is loaded.
#pragma once

#include <string>

namespace theatron::net {

// Takes BBR for what the TCP socket `descriptor` sends, if this kernel offers it; else the socket
// keeps its control. Never blocks.
void prefer_bbr(int descriptor);

// Name of the socket's congestion control, such as "bbr" or "cubic"; empty: the system tells none.
std::string congestion_control_of(int descriptor);

bool kernel_offers_bbr();

}  // namespace theatron::net
