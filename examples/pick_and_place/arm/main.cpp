// pick_and_place: the arm and the table for so long; the moves and where the parts lie as JSON.
// Exit status: 0 all parts are in a row; 1 they are not; 2 usage, or the world; 3 they are, but data
// were not valid or the log is not whole.
#include <cstdio>

#include <groundstate/closed_loop/command_line.hpp>

#include "closed_loop.hpp"

using namespace placing_system;
using groundstate::closed_loop::CommandLine;
using groundstate::closed_loop::Json;

namespace {

const char* text(Move move) {
    switch (move) {
        case Move::CLOSE: return "close";
        case Move::OPEN:
        case Move::REOPEN: return "open";
        default: return "go";
    }
}

void write_places(Json& json, const char* name, const std::vector<Place>& places) {
    json.column(name, places, [](Json& j, const Place& place) { j.numbers(std::array<double, 2>{place.x, place.y}); });
}

void write_columns(Json& json, const LoopSettings& settings, const Loop& loop) {
    json.key("slip").number(settings.slip);
    json.key("moves").open('{');
    json.column("t_s", loop.sent, [&](Json& j, const Sent& sent) {
        j.number(groundstate::closed_loop::seconds(sent.at_ns - loop.origin_ns));
    });
    json.column("kind", loop.sent, [](Json& j, const Sent& sent) { j.text(text(sent.move)); });
    json.column("place_m", loop.sent, [](Json& j, const Sent& sent) {
        j.numbers(std::array<double, 3>{sent.target.place.x, sent.target.place.y, sent.target.height});
    });
    json.close('}');
    json.key("end").open('{');
    write_places(json, "row_m", loop.row);
    write_places(json, "parts_m", loop.parts);
    json.key("placed").number(static_cast<double>(loop.placed));
    json.key("missed").number(static_cast<double>(loop.missed));
    json.key("worst_error_mm").number(loop.worst() * 1e3);
    json.key("in_a_row").truth(loop.in_a_row());
    json.close('}');
}

}  // namespace

int main(int count, char** words) {
    LoopSettings settings;
    CommandLine line{"pick_and_place", "An arm that puts parts in a row, in closed loop", settings.run};
    line.number("--parts", settings.parts, 1, static_cast<int>(example_row().size()), "how many there are; each takes about 11 s");
    line.share("--slip", settings.slip, "the share of grips that push the part aside");
    if (const auto status = line.read(count, words)) {
        return *status;
    }
    const Loop loop = run(settings);
    tell(loop.account);
    std::printf("%zu moves, %ld grips without a part\n", loop.sent.size(), loop.missed);
    std::printf("%zu of %zu parts placed, at most %.2f mm from their places: %s\n", loop.placed, loop.row.size(),
                loop.worst() * 1e3, loop.in_a_row() ? "in a row" : "not in a row");
    return line.end(loop.account, loop.in_a_row(), [&](Json& json) { write_columns(json, settings, loop); });
}
