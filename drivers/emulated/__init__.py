"""Wire-true devices and the machine behind them, for tests, demonstrations and training."""
