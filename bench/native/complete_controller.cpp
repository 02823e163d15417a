// The complete controller of the robot: the twin of ../../examples/visual_servoing/CompleteController.asm. A step is a tick:
// six schedulers take their tasks through the phases of a cycle and arbiters keep the lines before six locks. Undef is -1.
#include "driver.hpp"

namespace {

constexpr int undef = -1;

enum Scheduler { camera, visual_servoing, robot, motor, encoder, operator_, schedulers };
enum Buffer { camera_to_vs, vs_to_robot, encoder_to_robot, encoder_to_motor, robot_to_motor, robot_to_vs, buffers };
enum Phase {
    camera_grab, camera_write, camera_wait, vs_read_image, vs_elaborate, vs_write, vs_wait, robot_read_vs, robot_elaborate,
    robot_wait, robot_read_encoder, robot_write_motor, motor_read_encoder, motor_read_robot, motor_elaborate, motor_wait,
    encoder_acquire, encoder_write_robot, encoder_write_motor, encoder_wait, operator_plan, operator_send, operator_wait,
    vs_receive_target, vs_read_robot, robot_write_vs, phases
};
enum Action { WAITING_TRIGGER, ELABORATING, WRITING_ON_SB, READING_FROM_SB, SENDING, RECEIVING };
enum Pattern { WRITING, READING, MANAGING_SB };
enum Lock { READY, WAITING, EXECUTION };

constexpr const char* task_names[] = {"camera_task", "visual_servoing_task", "robot_task", "motor_task", "encoder_task", "operator_task"};
constexpr const char* scheduler_names[] = {"camera", "visual_servoing", "robot", "motor", "encoder", "operator"};
constexpr const char* buffer_names[] = {"camera_to_vs", "vs_to_robot", "encoder_to_robot", "encoder_to_motor", "robot_to_motor", "robot_to_vs"};
constexpr const char* phase_names[] = {
    "camera_grab", "camera_write", "camera_wait", "vs_read_image", "vs_elaborate", "vs_write", "vs_wait", "robot_read_vs",
    "robot_elaborate", "robot_wait", "robot_read_encoder", "robot_write_motor", "motor_read_encoder", "motor_read_robot",
    "motor_elaborate", "motor_wait", "encoder_acquire", "encoder_write_robot", "encoder_write_motor", "encoder_wait",
    "operator_plan", "operator_send", "operator_wait", "vs_receive_target", "vs_read_robot", "robot_write_vs"};
constexpr const char* action_names[] = {"WAITING_TRIGGER", "ELABORATING", "WRITING_ON_SB", "READING_FROM_SB", "SENDING", "RECEIVING"};
constexpr const char* pattern_names[] = {"WRITING", "READING", "MANAGING_SB"};
constexpr const char* lock_names[] = {"READY", "WAITING", "EXECUTION"};

// What is given once. The lock of a buffer has its number, a scheduler's task has the scheduler's.
constexpr int period[] = {100, undef, 50, 10, 5, undef};
constexpr int time_for_elaboration[] = {62, undef, 30, 8, 5, undef};
constexpr int users[][2] = {{camera, visual_servoing}, {robot, visual_servoing}, {encoder, robot},
                            {encoder, motor},          {motor, robot},           {robot, visual_servoing}};
constexpr int dimension[] = {2, 3, 2, 2, 2, 2};
constexpr int master[] = {vs_read_image, vs_write, robot_read_encoder, motor_read_encoder, robot_write_motor, vs_read_robot};
constexpr int capacity = 4;
struct Given {
    Action action;
    int time;
    Phase next;
    int buffer;
};
constexpr Given given[] = {
    {ELABORATING, 60, camera_write, undef},
    {WRITING_ON_SB, 1, camera_wait, camera_to_vs},
    {WAITING_TRIGGER, 1, camera_grab, undef},
    {READING_FROM_SB, 1, vs_read_robot, camera_to_vs},
    {ELABORATING, 120, vs_write, undef},
    {WRITING_ON_SB, 1, vs_wait, vs_to_robot},
    {WAITING_TRIGGER, 1, vs_receive_target, camera_to_vs},
    {READING_FROM_SB, 1, robot_read_encoder, vs_to_robot},
    {ELABORATING, 20, robot_write_motor, undef},
    {WAITING_TRIGGER, 1, robot_read_vs, undef},
    {READING_FROM_SB, 1, robot_elaborate, encoder_to_robot},
    {WRITING_ON_SB, 1, robot_write_vs, robot_to_motor},
    {READING_FROM_SB, 1, motor_read_robot, encoder_to_motor},
    {READING_FROM_SB, 1, motor_elaborate, robot_to_motor},
    {ELABORATING, 3, motor_wait, undef},
    {WAITING_TRIGGER, 1, motor_read_encoder, undef},
    {ELABORATING, 1, encoder_write_robot, undef},
    {WRITING_ON_SB, 1, encoder_write_motor, encoder_to_robot},
    {WRITING_ON_SB, 1, encoder_wait, encoder_to_motor},
    {WAITING_TRIGGER, 1, encoder_acquire, undef},
    {ELABORATING, 300, operator_send, undef},
    {SENDING, 1, operator_wait, undef},
    {WAITING_TRIGGER, 1, operator_plan, undef},
    {RECEIVING, 1, vs_read_image, undef},
    {READING_FROM_SB, 1, vs_elaborate, robot_to_vs},
    {WRITING_ON_SB, 1, robot_wait, robot_to_vs},
};

constexpr bool synchronous(int task) { return period[task] != undef; }
constexpr bool is_master(int phase) { return master[given[phase].buffer] == phase; }

}  // namespace

struct CompleteController {
    int clock = 0;
    int period_start[6], time_in_wait[6] = {}, cycles[6] = {}, met[6] = {}, missed[6] = {}, total_wait[6] = {};
    int longest_wait[6] = {}, skipped[6] = {};
    int lock[6][6] = {}, illegal[6] = {};
    int line[6] = {};  // who waits for a lock: none, one (1 + task) or two (1 + task, and 8 times 1 + the other task)
    int index_read[6], index_write[6] = {}, index_updated[6] = {}, pending[6] = {}, data[6][8], sequence[6][8] = {};
    int staged[6], received[6], received_sequence[6] = {}, fresh[6] = {}, writing_array[6], reading_array[6];
    int written[6] = {}, swaps[6] = {}, delivered[6] = {}, overwritten[6] = {}, unread[6] = {}, dropped[6] = {};
    int message = undef, slot[16], sent = 0, refused = 0, message_received = undef, taken = 0;
    int phase[6] = {camera_wait, vs_wait, robot_wait, motor_wait, encoder_wait, operator_wait}, action_start[6] = {};
    int control[phases];
    Update updates[256];
    int count = 0;

    CompleteController() {
        for (int t = 0; t < schedulers; ++t) period_start[t] = synchronous(t) ? -period[t] : 0;
        for (int b = 0; b < buffers; ++b) {
            index_read[b] = b == vs_to_robot ? 2 : 1;
            staged[b] = received[b] = writing_array[b] = reading_array[b] = undef;
            for (int& datum : data[b]) datum = undef;
        }
        for (int& held : slot) held = undef;
        for (int& state : control) state = undef;
    }

    void set(int& location, int value) { updates[count++] = {&location, value}; }

    // Locks.

    bool is_free(int s) const { return lock[s][users[s][0]] != EXECUTION && lock[s][users[s][1]] != EXECUTION; }
    int new_line(int s) const {
        int next = 0, place = 1;
        const auto add = [&](int t) {
            next += place * (1 + t);
            place *= 8;
        };
        const int first = line[s] % 8 - 1, second = line[s] / 8 - 1;
        if (first >= 0 && lock[s][first] == WAITING) add(first);
        if (second >= 0 && lock[s][second] == WAITING) add(second);
        for (const int t : users[s])
            if (t != first && t != second && lock[s][t] == WAITING) add(t);
        return next;
    }
    bool granted(int s, int t) const { return lock[s][t] == WAITING && is_free(s) && new_line(s) % 8 == 1 + t; }
    void arbitrate(int s) {
        if (line[s] != 0 || lock[s][users[s][0]] == WAITING || lock[s][users[s][1]] == WAITING) set(line[s], new_line(s));
    }

    // Tasks.

    int elapsed(int t) const { return clock - period_start[t]; }
    bool there_is_time(int t) const { return !synchronous(t) || time_in_wait[t] < period[t] - time_for_elaboration[t]; }
    void wait(int t) {
        const int waited = time_in_wait[t] + 1;
        set(time_in_wait[t], waited);
        set(total_wait[t], total_wait[t] + 1);
        set(longest_wait[t], longest_wait[t] > waited ? longest_wait[t] : waited);
    }
    void complete(int t) {
        set(cycles[t], cycles[t] + 1);
        set(time_in_wait[t], 0);
        if (synchronous(t)) {
            int& counter = elapsed(t) <= period[t] ? met[t] : missed[t];
            set(counter, counter + 1);
        }
    }

    // Swinging buffers.

    int newest(int b) const { return sequence[b][index_read[b]]; }
    void update_indexes(int b) {
        set(index_updated[b], 1);
        if (pending[b] == 0) return;
        set(index_read[b], index_write[b]);
        set(index_write[b], (index_write[b] + 1) % dimension[b]);
        set(pending[b], 0);
        set(swaps[b], swaps[b] + 1);
        if (newest(b) != received_sequence[b]) set(unread[b], unread[b] + 1);
    }
    void write(int b) {
        const int array = index_write[b], number = written[b] + 1;
        set(writing_array[b], array);
        set(data[b][array], staged[b]);
        set(sequence[b][array], number);
        set(written[b], number);
        set(pending[b], 1);
        if (pending[b] != 0) set(overwritten[b], overwritten[b] + 1);
    }
    void read(int b) {
        const int array = index_read[b], number = sequence[b][array];
        const bool is_new = number != received_sequence[b];
        set(reading_array[b], array);
        set(fresh[b], is_new);
        if (is_new) {
            set(received[b], data[b][array]);
            set(received_sequence[b], number);
            set(delivered[b], delivered[b] + 1);
        }
    }

    // Phases. A scheduler has the number of its task.

    bool data_available(int p) const {
        const int b = given[p].buffer;
        if (b != undef)
            return newest(b) != received_sequence[b] || (pending[b] != 0 && given[master[b]].action == READING_FROM_SB);
        return p != operator_send && p != vs_receive_target ? true : sent != taken;
    }
    bool trigger(int c) const { return synchronous(c) ? elapsed(c) >= period[c] : data_available(phase[c]); }
    bool is_over(int c) const { return clock - action_start[c] >= given[phase[c]].time; }
    bool lock_granted(int c) const { return granted(given[phase[c]].buffer, c); }
    bool managed(int c) const {
        return is_master(phase[c]) ? index_updated[given[phase[c]].buffer] != 0 : lock_granted(c);
    }
    bool gives_up(int c) const {
        return control[phase[c]] == MANAGING_SB && !managed(c) && !there_is_time(c) && !lock_granted(c);
    }

    void elaborate(int p) {
        switch (p) {
            case camera_grab: set(staged[camera_to_vs], clock); break;
            case vs_elaborate: set(staged[vs_to_robot], received[camera_to_vs]); break;
            case robot_elaborate:
                set(staged[robot_to_motor], received[vs_to_robot]);
                set(staged[robot_to_vs], received[encoder_to_robot]);
                break;
            case encoder_acquire:
                set(staged[encoder_to_robot], clock);
                set(staged[encoder_to_motor], clock);
                break;
            case operator_plan: set(message, sent + 1); break;
            default: break;
        }
    }
    void start_writing(int c, int p) {
        set(action_start[c], clock);
        write(given[p].buffer);
        set(control[p], WRITING);
    }
    void start_reading(int c, int p) {
        set(action_start[c], clock);
        read(given[p].buffer);
        set(control[p], READING);
    }
    void manage(int c, int p) {
        const int b = given[p].buffer;
        if (granted(b, c)) {
            set(lock[b][c], EXECUTION);
            if (is_master(p)) update_indexes(b);
        } else if (lock[b][c] == READY) {
            set(lock[b][c], WAITING);
        }
    }
    void start_managing(int c, int p) {
        manage(c, p);
        set(control[p], MANAGING_SB);
    }
    void enter_phase(int c, int p) {
        set(phase[c], p);
        switch (given[p].action) {
            case ELABORATING:
                set(action_start[c], clock);
                elaborate(p);
                break;
            case WRITING_ON_SB:
            case READING_FROM_SB:
                if (given[p].action == WRITING_ON_SB && is_master(p))
                    start_writing(c, p);
                else
                    start_managing(c, p);
                break;
            case RECEIVING:
                set(action_start[c], clock);
                if (sent != taken) {
                    set(message_received, slot[taken % capacity]);
                    set(taken, taken + 1);
                }
                break;
            default: break;
        }
    }
    void start_cycle(int c, int waiting) {
        if (synchronous(c)) set(period_start[c], period_start[c] + period[c]);
        enter_phase(c, given[waiting].next);
    }
    void leave_phase(int c) {
        const int current = phase[c], next = given[current].next;
        if (given[next].action != WAITING_TRIGGER) return enter_phase(c, next);
        complete(c);
        if (synchronous(c) && trigger(c) && given[next].next != current)
            start_cycle(c, next);
        else
            set(phase[c], next);
    }

    // Pattern machines.

    void leave_pattern(int c) {
        set(control[phase[c]], undef);
        leave_phase(c);
    }
    void release(int c) {
        const int b = given[phase[c]].buffer;
        if (is_master(phase[c])) set(index_updated[b], 0);
        if (lock[b][c] == EXECUTION)
            set(lock[b][c], READY);
        else
            set(illegal[b], 1);
    }
    void give_up(int c) {
        const int b = given[phase[c]].buffer;
        set(skipped[c], skipped[c] + 1);
        if (lock[b][c] == WAITING) set(lock[b][c], READY);
    }
    void retry(int c) {
        manage(c, phase[c]);
        if (!lock_granted(c)) wait(c);
    }
    void master_writing(int c) {
        const int p = phase[c], b = given[p].buffer;
        if (synchronous(c) && gives_up(c)) {
            give_up(c);
            leave_pattern(c);
        } else if (control[p] == undef) {
            start_writing(c, p);
        } else if (control[p] == WRITING) {
            if (is_over(c)) {
                set(writing_array[b], undef);
                start_managing(c, p);
            }
        } else if (control[p] == MANAGING_SB) {
            if (managed(c)) {
                release(c);
                leave_pattern(c);
            } else {
                retry(c);
            }
        }
    }
    void master_reading(int c) {
        const int p = phase[c], b = given[p].buffer;
        if (synchronous(c) && gives_up(c)) {
            give_up(c);
            start_reading(c, p);
        } else if (control[p] == undef) {
            start_managing(c, p);
        } else if (control[p] == MANAGING_SB) {
            if (managed(c)) {
                release(c);
                start_reading(c, p);
            } else {
                retry(c);
            }
        } else if (is_over(c)) {
            set(reading_array[b], undef);
            leave_pattern(c);
        }
    }
    void slave_action(int c) {
        const int p = phase[c], b = given[p].buffer;
        const bool writes = given[p].action == WRITING_ON_SB;
        if (synchronous(c) && gives_up(c)) {
            give_up(c);
            if (writes)
                set(dropped[b], dropped[b] + 1);
            else
                set(fresh[b], 0);
            leave_pattern(c);
        } else if (control[p] == undef) {
            start_managing(c, p);
        } else if (control[p] == MANAGING_SB) {
            if (lock_granted(c)) {
                manage(c, p);
                if (writes)
                    start_writing(c, p);
                else
                    start_reading(c, p);
            } else {
                retry(c);
            }
        } else if (is_over(c)) {
            set(control[p] == WRITING ? writing_array[b] : reading_array[b], undef);
            release(c);
            leave_pattern(c);
        }
    }
    void send(int c) {
        if (sent - taken >= capacity && there_is_time(c)) return wait(c);
        if (sent - taken >= capacity) {
            set(refused, refused + 1);
        } else {
            set(slot[sent % capacity], message);
            set(sent, sent + 1);
        }
        leave_phase(c);
    }

    void execute(int c) {
        switch (given[phase[c]].action) {
            case WAITING_TRIGGER:
                if (trigger(c)) start_cycle(c, phase[c]);
                break;
            case ELABORATING:
            case RECEIVING:
                if (is_over(c)) leave_phase(c);
                break;
            case WRITING_ON_SB:
                if (is_master(phase[c]))
                    master_writing(c);
                else
                    slave_action(c);
                break;
            case READING_FROM_SB:
                if (is_master(phase[c]))
                    master_reading(c);
                else
                    slave_action(c);
                break;
            case SENDING: send(c); break;
        }
    }

    void step() {
        for (int c = 0; c < schedulers; ++c) execute(c);
        for (int s = 0; s < buffers; ++s) arbitrate(s);
        set(clock, clock + 1);
        for (int i = 0; i < count; ++i) *updates[i].location = updates[i].value;
        count = 0;
    }

    // The state in the words of the model.

    static void put(int value) { value == undef ? std::printf("undef\n") : std::printf("%d\n", value); }
    static void put(const char* const* names, int value) { std::printf("%s\n", value == undef ? "undef" : names[value]); }
    static void truth(int value) { std::printf("%s\n", value != 0 ? "true" : "false"); }
    static void tasks(int first, int second) {
        std::printf("[%s%s%s]\n", first < 0 ? "" : task_names[first], second < 0 ? "" : ",", second < 0 ? "" : task_names[second]);
    }

    void print() const {
        std::printf("clock=%d\n", clock);
        for (int t = 0; t < schedulers; ++t) {
            const char* name = task_names[t];
            std::printf("task_kind(%s)=%s\n", name, synchronous(t) ? "SYNCHRONOUS" : "ASYNCHRONOUS");
            std::printf("task_period(%s)=", name), put(period[t]);
            std::printf("task_timeForElaboration(%s)=", name), put(time_for_elaboration[t]);
            std::printf("task_periodStart(%s)=%d\n", name, period_start[t]);
            std::printf("task_timeInWait(%s)=%d\n", name, time_in_wait[t]);
            std::printf("task_cycles(%s)=%d\n", name, cycles[t]);
            std::printf("task_deadlinesMet(%s)=%d\n", name, met[t]);
            std::printf("task_deadlinesMissed(%s)=%d\n", name, missed[t]);
            std::printf("task_totalWait(%s)=%d\n", name, total_wait[t]);
            std::printf("task_longestWait(%s)=%d\n", name, longest_wait[t]);
            std::printf("task_skipped(%s)=%d\n", name, skipped[t]);
            std::printf("scheduler_mainThread(%s)=%s\n", scheduler_names[t], name);
            std::printf("scheduler_currentPhase(%s)=%s\n", scheduler_names[t], phase_names[phase[t]]);
            std::printf("scheduler_actionStart(%s)=%d\n", scheduler_names[t], action_start[t]);
        }
        for (int b = 0; b < buffers; ++b) {
            const char* name = buffer_names[b];
            std::printf("sem_permits(%s_lock)=1\n", name);
            std::printf("sem_users(%s_lock)=", name), tasks(users[b][0], users[b][1]);
            for (int t = 0; t < schedulers; ++t) std::printf("sem_state(%s_lock,%s)=%s\n", name, task_names[t], lock_names[lock[b][t]]);
            std::printf("sem_illegalPost(%s_lock)=", name), truth(illegal[b]);
            std::printf("semaq(%s_lock)=", name), tasks(line[b] % 8 - 1, line[b] / 8 - 1);
            std::printf("dimension(%s)=%d\n", name, dimension[b]);
            std::printf("sem(%s)=%s_lock\n", name, name);
            std::printf("sb_master(%s)=%s\n", name, phase_names[master[b]]);
            std::printf("indexRead(%s)=%d\n", name, index_read[b]);
            std::printf("indexWrite(%s)=%d\n", name, index_write[b]);
            std::printf("indexUpdated(%s)=", name), truth(index_updated[b]);
            std::printf("sb_pending(%s)=", name), truth(pending[b]);
            for (int n = 0; n < 8; ++n) {
                std::printf("sb_data(%s,%d)=", name, n), put(data[b][n]);
                std::printf("sb_sequence(%s,%d)=%d\n", name, n, sequence[b][n]);
            }
            std::printf("sb_staged(%s)=", name), put(staged[b]);
            std::printf("sb_received(%s)=", name), put(received[b]);
            std::printf("sb_receivedSequence(%s)=%d\n", name, received_sequence[b]);
            std::printf("sb_fresh(%s)=", name), truth(fresh[b]);
            std::printf("sb_writingArray(%s)=", name), put(writing_array[b]);
            std::printf("sb_readingArray(%s)=", name), put(reading_array[b]);
            std::printf("sb_written(%s)=%d\n", name, written[b]);
            std::printf("sb_swaps(%s)=%d\n", name, swaps[b]);
            std::printf("sb_delivered(%s)=%d\n", name, delivered[b]);
            std::printf("sb_overwritten(%s)=%d\n", name, overwritten[b]);
            std::printf("sb_unread(%s)=%d\n", name, unread[b]);
            std::printf("sb_dropped(%s)=%d\n", name, dropped[b]);
        }
        std::printf("mq_capacity(targets)=%d\n", capacity);
        std::printf("mq_staged(targets)="), put(message);
        for (int n = 0; n < 16; ++n) std::printf("mq_slot(targets,%d)=", n), put(slot[n]);
        std::printf("mq_sent(targets)=%d\nmq_refused(targets)=%d\nmq_received(targets)=", sent, refused), put(message_received);
        std::printf("mq_taken(targets)=%d\n", taken);
        for (int p = 0; p < phases; ++p) {
            const char* name = phase_names[p];
            std::printf("action(%s)=%s\n", name, action_names[given[p].action]);
            std::printf("time(%s)=%d\n", name, given[p].time);
            std::printf("nextPhase(%s)=%s\n", name, phase_names[given[p].next]);
            std::printf("sharedMemory(%s)=", name), put(buffer_names, given[p].buffer);
            std::printf("messageQueue(%s)=%s\n", name, p == operator_send || p == vs_receive_target ? "targets" : "undef");
            std::printf("sb_ctrlState(%s)=", name), put(pattern_names, control[p]);
        }
        std::printf("elaborationRule(camera_grab)=<<r_captureImage>>\nelaborationRule(vs_elaborate)=<<r_computeSetPoint>>\n");
        std::printf("elaborationRule(robot_elaborate)=<<r_controlRobot>>\nelaborationRule(encoder_acquire)=<<r_readEncoders>>\n");
        std::printf("elaborationRule(operator_plan)=<<r_planTarget>>\n");
    }
};

int main(int argc, char** argv) { return run<CompleteController>(argc, argv); }
