"""Speed-controlled spindle drive as an FMU: controller, motor and all rotating inertia.

The bearing FMU reports what it takes from the shaft and nothing more, so the equation of the shaft is
here: ``J dOmega/dt = motor torque - load torque``, with J from the bearing's ``rotor.inertia``.

A PI controller runs at its own sampling rate, as drives do, and holds the torque in between. Torque and load
are then constant over each piece, the shaft equation is solved exactly, and the result depends on the
communication step only through how often the load torque is renewed.

``native/motor.c`` has the same equations in the same order of operations: results are equal to the last bit.
"""

from math import isfinite

from pythonfmu import DefaultExperiment, Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

# Two times closer than this are the same sampling instant: far below the sampling period, far above the
# rounding of a clock of some seconds.
SAME_TIME = 1e-10  # s
SHORTEST_PERIOD = 1e-6  # s: with shorter ones a step would never come to an end


class SpindleMotor(Fmi2Slave):
    """Drive that follows a linear run-up from a start speed to a target speed."""

    description = "Speed-controlled spindle drive with the rotating inertia"
    default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=5e-4)

    #: name, causality, unit, start value, what it is
    table = (
        ("load_torque", "input", "N.m", 0.0, "Torque taken from the shaft by what turns on it"),
        ("shaft_speed", "output", "rad/s", None, "Speed of the shaft"),
        ("speed_setpoint", "output", "rad/s", None, "Speed the controller is asked for"),
        ("motor_torque", "output", "N.m", None, "Torque of the motor on the shaft"),
        ("electrical_power", "output", "W", None, "Shaft power and copper loss; negative when braking"),
        # 2000 r/min: the bearing carries the load on its film from the first instant.
        ("start_speed", "parameter", "rad/s", 209.43951023931953, "Speed at the start"),
        ("target_speed", "parameter", "rad/s", 2094.3951023931954, "Speed after the run-up"),
        ("ramp_start", "parameter", "s", 0.0, "Begin of the run-up"),
        ("ramp_time", "parameter", "s", 0.7, "Duration of the run-up"),
        # Inner ring and rotor of the example scene; a master sets what the bearing says.
        ("rotor_inertia", "parameter", "kg.m2", 1.64e-4, "Polar inertia of everything that turns"),
        # 20 Hz (assumed): fast against the run-up, slow against the torque ripple of the balls.
        ("bandwidth", "parameter", "rad/s", 125.66370614359172, "Double pole of the speed control"),
        ("control_period", "parameter", "s", 1.0e-4, "Sampling period of the controller"),
        # Assumed: a 2 kW class motor spindle at 20,000 r/min.
        ("torque_limit", "parameter", "N.m", 1.0, "Largest torque, either way"),
        ("torque_constant", "parameter", "N.m/A", 0.03, "Torque per current"),
        ("winding_resistance", "parameter", "Ohm", 0.4, "Resistance that makes the copper loss"),
    )
    units = {name: unit for name, _, unit, _, _ in table}
    #: What each output depends on at the start.
    initial_dependencies = {
        "shaft_speed": ("start_speed",),
        "speed_setpoint": ("start_speed",),
        "motor_torque": ("load_torque", "torque_limit"),
        "electrical_power": (
            "load_torque", "start_speed", "torque_limit", "torque_constant", "winding_resistance"
        ),
    }  # fmt: skip

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.modelName = "SpindleMotor"
        for name, causality, _, start, text in self.table:
            setattr(self, name, 0.0 if start is None else start)
            fixed = causality == "parameter"
            self.register_variable(
                Real(
                    name,
                    causality=Fmi2Causality[causality],
                    variability=Fmi2Variability.fixed if fixed else Fmi2Variability.continuous,
                    description=text,
                )
            )
        self.shaft_speed = self.speed_setpoint = self.start_speed
        self.begin = 0.0
        self.samples = 0
        self.integral = 0.0

    def _get_fmu_state(self):
        """Return all there is to put back: pythonfmu keeps variables, not what the controller remembers."""
        hidden = ("begin", "samples", "integral")
        return super()._get_fmu_state() | {name: getattr(self, name) for name in hidden}

    def setup_experiment(self, start_time, stop_time=None, tolerance=None):
        """Take the start time: the run-up counts from there."""
        self.begin = start_time

    def exit_initialization_mode(self):
        """Start at the start speed, with the load carried."""
        self.samples = 0
        self.shaft_speed = self.speed_setpoint = self.start_speed
        self.integral = self.motor_torque = self._limited(self.load_torque)
        self._power()

    def do_step(self, current_time, step_size):
        """Advance; refused for a load torque or a parameter that makes no sense."""
        positive = (self.rotor_inertia, self.torque_constant, step_size)
        if not isfinite(self.load_torque) or not all(value > 0.0 for value in positive):
            return False
        if not self.control_period >= SHORTEST_PERIOD:
            return False
        now, end = current_time, current_time + step_size
        while end - now > SAME_TIME:
            due = self.begin + self.samples * self.control_period
            if due - now <= SAME_TIME:
                self._control(now)
                self.samples += 1
                due = self.begin + self.samples * self.control_period
            until = end if due - end > -SAME_TIME else due
            self.shaft_speed += (self.motor_torque - self.load_torque) / self.rotor_inertia * (until - now)
            now = until
        self._power()
        return True

    def _control(self, time):
        """One sample of the PI controller: both poles of the loop at ``-bandwidth``."""
        self.speed_setpoint = self._setpoint(time)
        error = self.speed_setpoint - self.shaft_speed
        proportional = 2.0 * self.rotor_inertia * self.bandwidth * error
        wanted = proportional + self.integral
        self.motor_torque = self._limited(wanted)
        # The integral waits while the torque is at its limit, or it would overshoot afterwards.
        if self.motor_torque == wanted:
            gain = self.rotor_inertia * self.bandwidth * self.bandwidth
            self.integral += gain * error * self.control_period

    def _setpoint(self, time):
        since = time - self.begin - self.ramp_start
        share = min(max(since / self.ramp_time, 0.0), 1.0) if self.ramp_time > 0.0 else float(since >= 0.0)
        return self.start_speed + share * (self.target_speed - self.start_speed)

    def _limited(self, torque):
        return min(max(torque, -self.torque_limit), self.torque_limit)

    def _power(self):
        current = self.motor_torque / self.torque_constant
        loss = self.winding_resistance * (current * current)
        self.electrical_power = self.motor_torque * self.shaft_speed + loss
