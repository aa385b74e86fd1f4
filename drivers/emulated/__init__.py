"""Wire-true devices and the machine behind them, for tests, demonstrations and training.

    station --pty------> nd280 ---- head ----.
            --TCP--> modbus_tcp -> el7 x 2 -> machine (motion, effects)

`spec` says what is emulated, `rig_file` reads it, `faults` spoils the wires on cue, `rig` holds all
together, `virtual` sequences the machine alone, in virtual time and without wires.
"""
