"""Wire-true devices and the machine behind them, for tests, demonstrations and training.

    station --pty------> nd280 ---- head ----.
            --TCP--> modbus_tcp -> el7 x 2 -> machine (motion, effects)

`spec` defines the emulation, `rig_file` reads it, `faults` disturbs the wires on schedule, `rig` combines
all, `virtual` sequences the machine alone, in virtual time and without wires.
"""
