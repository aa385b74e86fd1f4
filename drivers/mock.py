"""In-process devices without a wire, for unit tests only."""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Callable

from drivers.errors import DeviceError
from drivers.protocols import AxisStatus


class _Mock:
    """Records its calls; each method can be made to fail."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._failures: defaultdict[str, deque[DeviceError]] = defaultdict(deque)
        self.calls: list[str] = []
        """Names of the methods called so far, in order."""
        self.connected = False

    @property
    def name(self) -> str:
        return self._name

    def fail(self, method: str, error: DeviceError, *, times: int = 1) -> None:
        """The next `times` calls of `method` raise `error`."""
        self._failures[method].extend([error] * times)

    def connect(self) -> None:
        self._called("connect")
        self.connected = True

    def make_safe(self) -> None:
        self.calls.append("make_safe")

    def close(self) -> None:
        self.calls.append("close")
        self.connected = False

    def _called(self, method: str) -> None:
        self.calls.append(method)
        if self._failures[method]:
            raise self._failures[method].popleft()


class MockScale(_Mock):
    """A `LinearScale` that reads the value of a function."""

    def __init__(self, value_mm: Callable[[], float], *, name: str = "linear scale") -> None:
        super().__init__(name)
        self._value_mm = value_mm

    def read_mm(self) -> float:
        self._called("read_mm")
        return self._value_mm()


class MockAxis(_Mock):
    """A `ServoAxis` that reaches its target at once, unless it is held."""

    def __init__(self, *, name: str, theta_deg: float = 0.0) -> None:
        super().__init__(name)
        self.theta_deg = theta_deg
        self.enabled = False
        self.alarm: int | None = None
        self.held = False
        """While true, a move never ends."""
        self._target_deg: float | None = None

    def enable(self) -> None:
        self._called("enable")
        self.enabled = True

    def move_to(self, theta_deg: float, speed_deg_s: float) -> None:
        self._called("move_to")
        self._target_deg = theta_deg
        if not self.held:
            self.theta_deg = theta_deg

    def status(self) -> AxisStatus:
        self._called("status")
        arrived = self._target_deg == self.theta_deg
        return AxisStatus(
            enabled=self.enabled,
            moving=self._target_deg is not None and not arrived,
            in_position=arrived,
            alarm=self.alarm,
        )

    def feedback_deg(self) -> float:
        self._called("feedback_deg")
        return self.theta_deg

    def reset_alarm(self) -> None:
        self._called("reset_alarm")
        self.alarm = None

    def quick_stop(self) -> None:
        self._called("quick_stop")
        self._target_deg = None

    def preset(self, theta_deg: float) -> None:
        self._called("preset")
        self.theta_deg = theta_deg
        self._target_deg = None
