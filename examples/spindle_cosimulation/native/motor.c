/* Speed-controlled spindle drive: the equations of motor.py, in the same order of operations. */
#include "partner.h"

#include <math.h>

#define SHORTEST_PERIOD 1e-6 /* s: shorter ones would never come to an end */
#define SAME_TIME 1e-10 /* s: times closer than this are the same sampling instant */

enum { BEGIN, SAMPLES, INTEGRAL };

static double limited(const double *v, double torque)
{
    double most = v[TORQUE_LIMIT];
    if (-most > torque) torque = -most;
    return most < torque ? most : torque;
}

static void set_power(double *v)
{
    double current = v[MOTOR_TORQUE] / v[TORQUE_CONSTANT];
    v[ELECTRICAL_POWER] = v[MOTOR_TORQUE] * v[SHAFT_SPEED] + v[WINDING_RESISTANCE] * (current * current);
}

static double setpoint(const double *v, double since)
{
    double share = since >= 0.0;
    if (v[RAMP_TIME] > 0.0) {
        share = since / v[RAMP_TIME];
        if (0.0 > share) share = 0.0;
        if (1.0 < share) share = 1.0;
    }
    return v[START_SPEED] + share * (v[TARGET_SPEED] - v[START_SPEED]);
}

/* One sample of the PI controller: both poles of the loop at -bandwidth. The integral waits while the torque
 * is at its limit, or it would overshoot afterwards. */
static void control(double *v, double *hidden, double time)
{
    double inertia = v[ROTOR_INERTIA], bandwidth = v[BANDWIDTH], error, wanted;
    v[SPEED_SETPOINT] = setpoint(v, time - hidden[BEGIN] - v[RAMP_START]);
    error = v[SPEED_SETPOINT] - v[SHAFT_SPEED];
    wanted = 2.0 * inertia * bandwidth * error + hidden[INTEGRAL];
    v[MOTOR_TORQUE] = limited(v, wanted);
    if (v[MOTOR_TORQUE] == wanted) {
        hidden[INTEGRAL] += inertia * bandwidth * bandwidth * error * v[CONTROL_PERIOD];
    }
}

void model_initialise(double *v, double *hidden, double begin)
{
    hidden[BEGIN] = begin;
    hidden[SAMPLES] = 0.0;
    v[SHAFT_SPEED] = v[SPEED_SETPOINT] = v[START_SPEED];
    hidden[INTEGRAL] = v[MOTOR_TORQUE] = limited(v, v[LOAD_TORQUE]);
    set_power(v);
}

const char *model_step(double *v, double *hidden, double time, double size)
{
    double now = time, end = time + size;
    if (!(v[ROTOR_INERTIA] > 0.0)) return "rotor_inertia is not positive";
    if (!(v[CONTROL_PERIOD] >= SHORTEST_PERIOD)) return "control_period is below 1 us";
    if (!(v[TORQUE_CONSTANT] > 0.0)) return "torque_constant is not positive";
    while (end - now > SAME_TIME) {
        double due = hidden[BEGIN] + hidden[SAMPLES] * v[CONTROL_PERIOD], until;
        if (due - now <= SAME_TIME) {
            control(v, hidden, now);
            hidden[SAMPLES] += 1.0;
            due = hidden[BEGIN] + hidden[SAMPLES] * v[CONTROL_PERIOD];
        }
        until = due - end > -SAME_TIME ? end : due;
        v[SHAFT_SPEED] += (v[MOTOR_TORQUE] - v[LOAD_TORQUE]) / v[ROTOR_INERTIA] * (until - now);
        now = until;
    }
    set_power(v);
    return NULL;
}
