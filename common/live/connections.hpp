// Ends every connection of a server at once.
#pragma once

namespace fc::live {

// Shuts every socket of this process whose own address is 127.0.0.1:port: reads and writes that wait there return. The HTTP
// library has no way to do so, and would wait for idle connections until their time is out, which is seconds.
void cut_connections(int port);

}  // namespace fc::live
